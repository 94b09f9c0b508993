// SPDX-License-Identifier: GPL-3.0-or-later
// Young's and shear modulus in every direction from a 6 x 6 stiffness (Voigt order xx yy zz yz xz xy, engineering shear strains).
// Nye, Physical Properties of Crystals (1957), chapter VIII; bounds and anisotropy: Hill (1952), Ranganathan and Ostoja-Starzewski (2008).

export type Vector = [number, number, number];
export type Matrix = number[][];

/** The inverse by Gauss and Jordan with pivots; null where the matrix is singular to within rounding. */
export function inverse(matrix: Matrix): Matrix | null {
  const n = matrix.length;
  const largest = Math.max(...matrix.flat().map(Math.abs));
  const rows = matrix.map((row, i) => [...row, ...Array.from({ length: n }, (_, j) => (i === j ? 1 : 0))]);
  for (let column = 0; column < n; ++column) {
    let pivot = column;
    for (let row = column + 1; row < n; ++row) {
      if (Math.abs(rows[row]![column]!) > Math.abs(rows[pivot]![column]!)) {
        pivot = row;
      }
    }
    if (!(Math.abs(rows[pivot]![column]!) > 1e-12 * largest)) {
      return null;
    }
    [rows[column], rows[pivot]] = [rows[pivot]!, rows[column]!];
    const scale = rows[column]![column]!;
    rows[column] = rows[column]!.map((value) => value / scale);
    for (let row = 0; row < n; ++row) {
      const factor = row === column ? 0 : rows[row]![column]!;
      if (factor !== 0) {
        rows[row] = rows[row]!.map((value, k) => value - factor * rows[column]![k]!);
      }
    }
  }
  return rows.map((row) => row.slice(n));
}

/** x^T S y */
function product(compliance: Matrix, x: number[], y: number[]): number {
  return compliance.reduce((sum, row, i) => sum + x[i]! * row.reduce((part, value, j) => part + value * y[j]!, 0), 0);
}

/** Voigt form of the stress n m^T + m n^T, or of n n^T when both are the same direction. */
function stress(n: Vector, m: Vector, same: boolean): number[] {
  const f = same ? 0.5 : 1;
  return [2 * n[0] * m[0], 2 * n[1] * m[1], 2 * n[2] * m[2], n[1] * m[2] + n[2] * m[1], n[0] * m[2] + n[2] * m[0], n[0] * m[1] + n[1] * m[0]]
    .map((value) => f * value);
}

/** Stretched along n by a stress along n. */
export function youngsModulus(compliance: Matrix, n: Vector): number {
  const along = stress(n, n, true);
  return 1 / product(compliance, along, along);
}

/** Of plates normal to n. 1/G is a quadratic form of the direction of shear in the plate: its mean and its ends follow from two directions. */
export function shearModulus(compliance: Matrix, n: Vector): { mean: number; least: number; most: number } {
  const [first, second] = across(n);
  const [a, b] = [stress(n, first, false), stress(n, second, false)];
  const [aa, bb, ab] = [product(compliance, a, a), product(compliance, b, b), product(compliance, a, b)];
  const mean = 0.5 * (aa + bb);
  const reach = Math.hypot(0.5 * (aa - bb), ab);
  return { mean: 1 / mean, least: 1 / (mean + reach), most: 1 / (mean - reach) };
}

/** Two directions across n. */
function across(n: Vector): [Vector, Vector] {
  const helper: Vector = Math.abs(n[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
  const cross = (u: Vector, v: Vector): Vector => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const first = cross(n, helper);
  const length = Math.hypot(...first);
  const unit = first.map((value) => value / length) as Vector;
  return [unit, cross(n, unit)];
}

export interface Averages {
  bulk: { voigt: number; reuss: number };
  shear: { voigt: number; reuss: number };
  /** 5 G_V/G_R + K_V/K_R - 6; 0 when isotropic. */
  anisotropy: number;
}

export function averages(c: Matrix, s: Matrix): Averages {
  const sum = (m: Matrix, pairs: [number, number][]): number => pairs.reduce((total, [i, j]) => total + m[i]![j]!, 0);
  const diagonal: [number, number][] = [[0, 0], [1, 1], [2, 2]];
  const off: [number, number][] = [[0, 1], [1, 2], [0, 2]];
  const shears: [number, number][] = [[3, 3], [4, 4], [5, 5]];
  const bulk = { voigt: (sum(c, diagonal) + 2 * sum(c, off)) / 9, reuss: 1 / (sum(s, diagonal) + 2 * sum(s, off)) };
  const shear = {
    voigt: (sum(c, diagonal) - sum(c, off) + 3 * sum(c, shears)) / 15,
    reuss: 15 / (4 * (sum(s, diagonal) - sum(s, off)) + 3 * sum(s, shears)),
  };
  return { bulk, shear, anisotropy: (5 * shear.voigt) / shear.reuss + bulk.voigt / bulk.reuss - 6 };
}
