// SPDX-License-Identifier: GPL-3.0-or-later
// What the views show. All views of a page share one set.

import type { MapName } from "../colours";

export const axisNames = ["x", "y", "z"];
export const axisColours = ["#e8452f", "#2e9e4f", "#4878ff"];

export type Plane = "xy" | "xz" | "yz";
export const planes: Plane[] = ["xy", "xz", "yz"];

/** How one quantity is coloured, and which of its values are drawn. */
export interface Colouring {
  /** Null: the map that suits the quantity. */
  map: MapName | null;
  /** Ends of the range in the unit of the file; null: that of the bulk of the values. */
  low: number | null;
  high: number | null;
  /** What lies outside the range is not drawn. */
  within: boolean;
}

export const automatic: Colouring = { map: null, low: null, high: null, within: false };

export interface Settings {
  spheres: boolean;
  /** Radius drawn over radius. */
  sphereScale: number;
  /** What colours the particles: a name of `particleColours`. */
  colourBy: string;
  logarithmic: boolean;
  particles: Colouring;
  /** Shear plane of forces, backbone and fields that belong to one. */
  plane: Plane;
  /** "none", "plain" or a name of `bondColours`. */
  bonds: string;
  bondColours: Colouring;
  /** A vector field of the particles that is drawn as arrows; "none". */
  arrows: string;
  /** Length of an arrow of the root mean square vector, in mean radii. */
  arrowLength: number;
  backboneOnly: boolean;
  slab: { on: boolean; axis: 0 | 1 | 2; position: number; thickness: number };
  pores: number;
  images: "none" | "layer" | "double";
  box: boolean;
  /** Without perspective: equal lengths look equal. */
  parallel: boolean;
}

export const defaults: Settings = {
  spheres: true,
  sphereScale: 1,
  colourBy: "coordination",
  logarithmic: false,
  particles: automatic,
  plane: "xy",
  bonds: "none",
  bondColours: automatic,
  arrows: "none",
  arrowLength: 1,
  backboneOnly: false,
  slab: { on: false, axis: 2, position: 0.5, thickness: 0.15 },
  pores: 0,
  images: "none",
  box: true,
  parallel: false,
};
