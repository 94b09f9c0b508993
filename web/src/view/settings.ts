// What the views show. All views of a page share one set.

export type Plane = "xy" | "xz" | "yz";
export const planes: Plane[] = ["xy", "xz", "yz"];

export interface Settings {
  spheres: boolean;
  /** Radius drawn over radius. */
  sphereScale: number;
  /** What colours the particles: a name of `particleColours`. */
  colourBy: string;
  logarithmic: boolean;
  /** Shear plane of forces, backbone and fields that belong to one. */
  plane: Plane;
  /** "none", "plain" or a name of `bondColours`. */
  bonds: string;
  backboneOnly: boolean;
  slab: { on: boolean; axis: 0 | 1 | 2; position: number; thickness: number };
  pores: number;
  images: "none" | "layer" | "double";
  box: boolean;
}

export const defaults: Settings = {
  spheres: true,
  sphereScale: 1,
  colourBy: "coordination",
  logarithmic: false,
  plane: "xy",
  bonds: "none",
  backboneOnly: false,
  slab: { on: false, axis: 2, position: 0.5, thickness: 0.15 },
  pores: 0,
  images: "none",
  box: true,
};
