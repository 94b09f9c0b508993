// SPDX-License-Identifier: GPL-3.0-or-later
// A structure as the views need it: fields by name and plane, clusters, backbone, neighbours, periodic images.

import type { Field, Numbers, Structure } from "../data";
import { planes, type Plane, type Settings } from "./settings";

/** A field of the particles or bonds under its name without the plane. */
export interface NamedField {
  label: string;
  unit: string;
  description: string;
  /** Per unit strain, where the label does not say so. */
  perStrain: boolean;
  /** What negative and positive values mean, where they mean different things. */
  signs: [string, string] | null;
  /** Under each plane, or under "" for all; of a vector its length. */
  values: Map<Plane | "", Numbers>;
  /** Of a vector its components, likewise. */
  vectors: Map<Plane | "", Numbers>;
}

export interface Bond {
  /** Its number in the file. */
  number: number;
  neighbour: number;
}

/** Which particles and bonds are drawn. */
export interface Selection {
  particle: (i: number) => boolean;
  bond: (k: number) => boolean;
}

export const everything: Selection = { particle: () => true, bond: () => true };

/** Range of boxes that are drawn, in lengths of the box: [0, 1] is the box itself. */
export interface Extent {
  low: number;
  high: number;
}

const labels: Record<string, string> = {
  coordination: "coordination",
  nonaffinity: "non-affinity",
  energy_share: "participation (share of the energy)",
  nonaffine_displacement: "non-affine displacement",
};

function lengthsOf(vectors: Numbers, components: number): Float32Array {
  return Float32Array.from({ length: vectors.length / components }, (_, i) => Math.hypot(...vectors.subarray(components * i, components * (i + 1))));
}

/** The name of a field with what it refers to. */
export function fullLabel(field: NamedField): string {
  return field.label + (field.perStrain ? " per unit strain" : "");
}

export class Model {
  readonly fields = new Map<string, NamedField>();
  readonly bondFields = new Map<string, NamedField>();
  /** Rank of the cluster of each particle by size, from 0; -1 for particles without bonds. */
  readonly cluster: Int32Array;
  readonly clusterSizes: number[];
  /** Bonds of each particle. */
  readonly neighbours: Bond[][];

  constructor(readonly structure: Structure) {
    const metres = structure.lengthUnit;
    this.add(this.fields, { name: "radius", unit: "m", description: "radius of the particle",
      values: structure.radii.map((radius) => radius * metres) });
    for (const field of structure.fields.filter(({ name }) => name !== "cluster")) { // clusters are found below, for files without them, too
      this.add(this.fields, field);
    }
    for (const field of structure.bondFields) {
      this.add(this.bondFields, { ...field, name: shortName(field.name) });
    }
    this.neighbours = this.findNeighbours();
    if (!this.fields.has("coordination")) {
      this.add(this.fields, { name: "coordination", unit: "1", description: "number of bonds of the particle",
        values: Float32Array.from(this.neighbours, (bonds) => bonds.length) });
    }
    [this.cluster, this.clusterSizes] = this.findClusters();
    this.add(this.fields, { name: "cluster", unit: "1", description: "number of the cluster by size, from 1; 0 for a particle without bonds",
      values: Float32Array.from(this.cluster, (cluster) => cluster + 1) });
  }

  /** Values of a field under a plane; null where the file has none. */
  field(name: string, plane: Plane): Numbers | null {
    const field = this.fields.get(name);
    return field ? (field.values.get(plane) ?? field.values.get("") ?? null) : null;
  }

  /** Components of a vector field under a plane; null where the file has none. */
  vectors(name: string, plane: Plane): Numbers | null {
    const field = this.fields.get(name);
    return field ? (field.vectors.get(plane) ?? field.vectors.get("") ?? null) : null;
  }

  bondField(name: string, plane: Plane): Numbers | null {
    const field = this.bondFields.get(name);
    return field ? (field.values.get(plane) ?? field.values.get("") ?? null) : null;
  }

  /** Particles and bonds of the backbone alone, if that is wanted. */
  inBackbone(settings: Settings): Selection {
    const backbone = settings.backboneOnly ? this.bondField("backbone", settings.plane) : null;
    if (!backbone) {
      return everything;
    }
    const inside = new Uint8Array(this.structure.particles);
    const ends = this.structure.bonds!.ends;
    backbone.forEach((flag, k) => {
      if (flag) {
        inside[ends[2 * k]!] = 1;
        inside[ends[2 * k + 1]!] = 1;
      }
    });
    return { particle: (i) => inside[i] === 1, bond: (k) => backbone[k] === 1 };
  }

  /** Lengths of the box that are drawn. */
  extent(settings: Settings): Extent {
    const layer = 0.2;
    if (!this.structure.periodic || settings.images === "none") {
      return { low: 0, high: 1 };
    }
    return settings.images === "layer" ? { low: -layer, high: 1 + layer } : { low: 0, high: 2 };
  }

  /** Calls `visit` with each shift (in lengths of the box) by which a point of the box comes into the extent. */
  forImages(x: number, y: number, z: number, extent: Extent, visit: (dx: number, dy: number, dz: number) => void): void {
    const [lx, ly, lz] = this.structure.lengths;
    if (extent.low === 0 && extent.high === 1) {
      visit(0, 0, 0);
      return;
    }
    for (let a = Math.floor(extent.low); a < extent.high; ++a) {
      for (let b = Math.floor(extent.low); b < extent.high; ++b) {
        for (let c = Math.floor(extent.low); c < extent.high; ++c) {
          const inside = (t: number): boolean => t >= extent.low && t < extent.high;
          if (inside(x / lx + a) && inside(y / ly + b) && inside(z / lz + c)) {
            visit(a * lx, b * ly, c * lz);
          }
        }
      }
    }
  }

  private add(fields: Map<string, NamedField>, field: Field): void {
    const match = /^(.*)_(xy|xz|yz)$/.exec(field.name);
    const name = match ? match[1]! : field.name;
    const plane = match ? (match[2] as Plane) : "";
    const entry = fields.get(name) ?? {
      label: (fields === this.fields ? labels[name] : null) ?? name.replaceAll("_", " "),
      unit: field.unit,
      description: field.description.replace(/ under shear (xy|xz|yz)/, "").replace(/ (xy|xz|yz)( |$)/, "$2"),
      perStrain: /per unit (shear )?strain/.test(field.description),
      signs: /positive where it is pulled/.test(field.description) ? ["compression", "tension"] as [string, string] : null,
      values: new Map<Plane | "", Numbers>(),
      vectors: new Map<Plane | "", Numbers>(),
    };
    const components = field.components ?? 1;
    if (components === 3) {
      entry.vectors.set(plane, field.values);
    }
    entry.values.set(plane, components > 1 ? lengthsOf(field.values, components) : field.values);
    fields.set(name, entry);
  }

  private findNeighbours(): Bond[][] {
    const found: Bond[][] = Array.from({ length: this.structure.particles }, () => []);
    const ends = this.structure.bonds?.ends ?? new Uint32Array();
    for (let k = 0; 2 * k < ends.length; ++k) {
      const [i, j] = [ends[2 * k]!, ends[2 * k + 1]!];
      found[i]!.push({ number: k, neighbour: j });
      found[j]!.push({ number: k, neighbour: i });
    }
    return found;
  }

  private findClusters(): [Int32Array, number[]] {
    const label = new Int32Array(this.structure.particles).fill(-1);
    const sizes: number[] = [];
    for (let start = 0; start < label.length; ++start) {
      if (label[start] !== -1 || this.neighbours[start]!.length === 0) {
        continue;
      }
      const stack = [start];
      label[start] = sizes.length;
      let size = 0;
      for (let i = stack.pop(); i !== undefined; i = stack.pop()) {
        ++size;
        for (const { neighbour } of this.neighbours[i]!) {
          if (label[neighbour] === -1) {
            label[neighbour] = sizes.length;
            stack.push(neighbour);
          }
        }
      }
      sizes.push(size);
    }
    const order = sizes.map((_, k) => k).sort((a, b) => sizes[b]! - sizes[a]!);
    const rank = new Int32Array(sizes.length);
    order.forEach((cluster, place) => { rank[cluster] = place; });
    return [label.map((cluster) => (cluster < 0 ? -1 : rank[cluster]!)), order.map((cluster) => sizes[cluster]!)];
  }
}

/** "/mechanics/linear/load_structure/xy/bonds/normal_force" is normal_force_xy; of other methods, "normal_force (dem)_xy". */
function shortName(path: string): string {
  const parts = path.split("/");
  const method = parts[2] ?? "linear";
  const plane = parts.find((part) => (planes as string[]).includes(part));
  return (parts[parts.length - 1] ?? path) + (method === "linear" ? "" : ` (${method})`) + (plane ? `_${plane}` : "");
}
