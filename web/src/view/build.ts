// SPDX-License-Identifier: GPL-3.0-or-later
// From a structure and settings to the instances that are drawn. Lengths in units of the mean radius, from the centre of the box.

import type { Vector3 } from "three";
import type { Rgb } from "../colours";
import type { Numbers } from "../data";
import type { Attributes } from "./instances";
import type { Model, Selection } from "./model";
import type { Paint } from "./paint";
import type { Settings } from "./settings";

/** Colours of particles and bonds, by their number. */
export interface Painter {
  particle: (i: number) => Rgb;
  bond: (k: number) => Rgb;
  /** Width of a bond, 0 to 1. */
  width: (k: number) => number;
}

export interface ParticleInstances {
  attributes: Attributes;
  /** Number of the particle of each instance. */
  particle: Uint32Array;
  centres: Float32Array;
  radii: Float32Array;
}

const stickWidth = 0.16; // of the mean radius

export function particleInstances(model: Model, settings: Settings, { painter, selection }: Paint, half: Vector3): ParticleInstances {
  const { positions, radii } = model.structure;
  const extent = model.extent(settings);
  const particle: number[] = [];
  const centres: number[] = [];
  for (let i = 0; settings.spheres && i < radii.length; ++i) {
    if (!selection.particle(i)) {
      continue;
    }
    const [x, y, z] = [positions[3 * i]!, positions[3 * i + 1]!, positions[3 * i + 2]!];
    model.forImages(x, y, z, extent, (dx, dy, dz) => {
      particle.push(i);
      centres.push(x + dx - half.x, y + dy - half.y, z + dz - half.z);
    });
  }
  const tint = new Uint8Array(3 * particle.length);
  particle.forEach((i, k) => tint.set(painter.particle(i), 3 * k));
  const placed = Float32Array.from(centres);
  const sizes = Float32Array.from(particle, (i) => radii[i]!);
  return {
    attributes: {
      centre: { array: placed, size: 3 },
      radius: { array: sizes, size: 1 },
      tint: { array: tint, size: 3, normalized: true },
      mark: { array: new Float32Array(particle.length), size: 1 },
    },
    particle: Uint32Array.from(particle),
    centres: placed,
    radii: sizes,
  };
}

/** A bond whose other end is not drawn, such as one through the boundary of the box, is drawn half. */
export function bondInstances(model: Model, settings: Settings, { painter, selection }: Paint, half: Vector3): { attributes: Attributes; count: number } {
  const { bonds, positions, lengths } = model.structure;
  const starts: number[] = [];
  const branches: number[] = [];
  const number: number[] = [];
  if (bonds && settings.bonds !== "none") {
    const extent = model.extent(settings);
    const open = !model.structure.periodic;
    const contains = (x: number, y: number, z: number): boolean => open ||
      [x / lengths[0], y / lengths[1], z / lengths[2]].every((t) => t >= extent.low && t < extent.high);
    for (let k = 0; 2 * k < bonds.ends.length; ++k) {
      if (!selection.bond(k)) {
        continue;
      }
      for (const [end, sign] of [[0, 1], [1, -1]] as const) {
        const i = bonds.ends[2 * k + end]!;
        const branch = [0, 1, 2].map((c) => sign * bonds.branches[3 * k + c]!) as [number, number, number];
        const at = [0, 1, 2].map((c) => positions[3 * i + c]!) as [number, number, number];
        model.forImages(...at, extent, (dx, dy, dz) => {
          const whole = contains(at[0] + dx + branch[0], at[1] + dy + branch[1], at[2] + dz + branch[2]);
          if (whole && end === 1) {
            return; // drawn from its first end
          }
          const part = whole ? 1 : 0.5;
          starts.push(at[0] + dx - half.x, at[1] + dy - half.y, at[2] + dz - half.z);
          branches.push(part * branch[0], part * branch[1], part * branch[2]);
          number.push(k);
        });
      }
    }
  }
  const tint = new Uint8Array(3 * number.length);
  number.forEach((k, place) => tint.set(painter.bond(k), 3 * place));
  return {
    attributes: {
      start: { array: Float32Array.from(starts), size: 3 },
      branch: { array: Float32Array.from(branches), size: 3 },
      width: { array: Float32Array.from(number, (k) => stickWidth * (0.3 + 0.9 * painter.width(k))), size: 1 },
      taper: { array: new Float32Array(number.length), size: 1 },
      tint: { array: tint, size: 3, normalized: true },
    },
    count: number.length,
  };
}

const arrowColour: Rgb = [213, 94, 0];
const shaft = 0.68; // of the length of an arrow; its head is the rest

/** Root mean square length of the vectors of all particles, in the unit of the file. */
export function rmsLength(vectors: Numbers): number {
  let sum = 0;
  for (const value of vectors) {
    sum += value * value;
  }
  return Math.sqrt(sum / (vectors.length / 3));
}

/** Arrows from the centres: a shaft and a cone each. */
export function arrowInstances(model: Model, settings: Settings, selection: Selection, half: Vector3): { attributes: Attributes; count: number } {
  const vectors = settings.arrows === "none" ? null : model.vectors(settings.arrows, settings.plane);
  const starts: number[] = [];
  const branches: number[] = [];
  const widths: number[] = [];
  const tapers: number[] = [];
  const scale = vectors ? settings.arrowLength / (rmsLength(vectors) || 1) : 0;
  const { positions } = model.structure;
  const add = (from: number[], branch: number[], width: number, taper: number): void => {
    starts.push(...from);
    branches.push(...branch);
    widths.push(width);
    tapers.push(taper);
  };
  for (let i = 0; vectors && 3 * i < vectors.length; ++i) {
    const arrow = [0, 1, 2].map((c) => scale * vectors[3 * i + c]!);
    const length = Math.hypot(...arrow);
    if (!selection.particle(i) || length < 0.02) {
      continue;
    }
    const width = 0.07 * Math.min(1, length);
    const [x, y, z] = [positions[3 * i]!, positions[3 * i + 1]!, positions[3 * i + 2]!];
    model.forImages(x, y, z, model.extent(settings), (dx, dy, dz) => {
      const from = [x + dx - half.x, y + dy - half.y, z + dz - half.z];
      add(from, arrow.map((part) => shaft * part), width, 0);
      add(from.map((part, c) => part + shaft * arrow[c]!), arrow.map((part) => (1 - shaft) * part), 2.6 * width, 1);
    });
  }
  const tint = new Uint8Array(starts.length);
  tint.forEach((_, k) => { tint[k] = arrowColour[k % 3]!; });
  return {
    attributes: {
      start: { array: Float32Array.from(starts), size: 3 },
      branch: { array: Float32Array.from(branches), size: 3 },
      width: { array: Float32Array.from(widths), size: 1 },
      taper: { array: Float32Array.from(tapers), size: 1 },
      tint: { array: tint, size: 3, normalized: true },
    },
    count: widths.length,
  };
}

const poreColour: Rgb = [64, 156, 255];

export function poreInstances(model: Model, settings: Settings, half: Vector3): { attributes: Attributes; count: number } {
  const { centres, radii } = model.structure.pores;
  const extent = model.extent(settings);
  const placed: number[] = [];
  const sizes: number[] = [];
  for (let k = 0; k < Math.min(settings.pores, radii.length); ++k) {
    const [x, y, z] = [centres[3 * k]!, centres[3 * k + 1]!, centres[3 * k + 2]!];
    model.forImages(x, y, z, extent, (dx, dy, dz) => {
      placed.push(x + dx - half.x, y + dy - half.y, z + dz - half.z);
      sizes.push(radii[k]!);
    });
  }
  const tint = new Uint8Array(3 * sizes.length);
  sizes.forEach((_, k) => tint.set(poreColour, 3 * k));
  return {
    attributes: {
      centre: { array: Float32Array.from(placed), size: 3 },
      radius: { array: Float32Array.from(sizes), size: 1 },
      tint: { array: tint, size: 3, normalized: true },
      mark: { array: new Float32Array(sizes.length), size: 1 },
    },
    count: sizes.length,
  };
}
