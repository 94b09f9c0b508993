// SPDX-License-Identifier: GPL-3.0-or-later
// Which sphere a ray meets first.

import { Vector3 } from "three";
import type { ParticleInstances } from "./build";
import type { Settings } from "./settings";

/** Ends of the slab along its axis, from the centre of the box. */
export function slabRangeOf(settings: Settings, half: Vector3): [number, number] {
  const { axis, position, thickness } = settings.slab;
  const length = 2 * half.getComponent(axis);
  const centre = (position - 0.5) * length;
  return [centre - 0.5 * thickness * length, centre + 0.5 * thickness * length];
}

/** The instance whose visible part, inside the slab, is nearest; null where the ray meets none. */
export function nearestHit(drawn: ParticleInstances, eye: Vector3, direction: Vector3, settings: Settings, half: Vector3): number | null {
  const [low, high] = slabRangeOf(settings, half);
  const axis = settings.slab.axis;
  let from = 0;
  let to = Infinity;
  if (settings.slab.on) {
    const slope = direction.getComponent(axis) || 1e-12;
    const crossings = [(low - eye.getComponent(axis)) / slope, (high - eye.getComponent(axis)) / slope];
    from = Math.max(0, Math.min(...crossings));
    to = Math.max(...crossings);
  }
  let best: number | null = null;
  let nearest = Infinity;
  const { centres, radii } = drawn;
  for (let k = 0; k < radii.length; ++k) {
    const x = centres[3 * k]! - eye.x;
    const y = centres[3 * k + 1]! - eye.y;
    const z = centres[3 * k + 2]! - eye.z;
    const along = x * direction.x + y * direction.y + z * direction.z;
    const radius = radii[k]! * settings.sphereScale;
    const inside = radius * radius - (x * x + y * y + z * z - along * along);
    if (inside < 0) {
      continue;
    }
    const enter = Math.max(from, along - Math.sqrt(inside));
    if (enter <= Math.min(to, along + Math.sqrt(inside)) && enter > 0 && enter < nearest) {
      nearest = enter;
      best = k;
    }
  }
  return best;
}
