// SPDX-License-Identifier: GPL-3.0-or-later
// Instances from front to back: what lies behind needs no fragments then.

import type { Vector3 } from "three";

const buckets = 1024;

/** Numbers of points [x, y, z ...], those nearest to the eye first, to within a bucket of depth. Linear in their number. */
export function frontToBack(points: Float32Array, toEye: Vector3): Uint32Array {
  const count = points.length / 3;
  const depth = new Float32Array(count);
  let low = Infinity;
  let high = -Infinity;
  for (let k = 0; k < count; ++k) {
    const d = -(points[3 * k]! * toEye.x + points[3 * k + 1]! * toEye.y + points[3 * k + 2]! * toEye.z);
    depth[k] = d;
    low = Math.min(low, d);
    high = Math.max(high, d);
  }
  const scale = high > low ? (buckets - 1) / (high - low) : 0;
  const starts = new Uint32Array(buckets + 1);
  depth.forEach((d) => { ++starts[1 + Math.floor((d - low) * scale)]!; });
  for (let bucket = 0; bucket < buckets; ++bucket) {
    starts[bucket + 1]! += starts[bucket]!;
  }
  const order = new Uint32Array(count);
  depth.forEach((d, k) => { order[starts[Math.floor((d - low) * scale)]!++] = k; });
  return order;
}
