// SPDX-License-Identifier: GPL-3.0-or-later
// Many spheres or sticks in one call of the graphics card. Each is a quad of four vertices with the same attributes: instances in the
// sense of WebGL take some 20 microseconds each where graphics run in software, ten times as long.

import { BufferAttribute, BufferGeometry, Color, GLSL3, Mesh, NormalBlending, RawShaderMaterial, Vector2, Vector4 } from "three";
import { sphereFragment, sphereVertex, stickFragment, stickVertex } from "./shaders";

/** What all kinds share; the slab is in the space of the eye and changes with the camera. */
export interface SharedUniforms {
  parallel: { value: boolean };
  slab: { value: Vector4 };
  slabRange: { value: Vector2 };
  haze: { value: Color };
  hazeRange: { value: Vector2 };
  [name: string]: { value: unknown };
}

export function sharedUniforms(): SharedUniforms {
  return {
    parallel: { value: false },
    slab: { value: new Vector4() },
    slabRange: { value: new Vector2() },
    haze: { value: new Color(1, 1, 1) },
    hazeRange: { value: new Vector2(0, 1) },
  };
}

export type Attributes = Record<string, { array: Float32Array | Uint8Array; size: number; normalized?: boolean }>;

const corners = 4;

export class Instances {
  readonly mesh: Mesh<BufferGeometry, RawShaderMaterial>;
  private readonly scale = { value: 1 };
  /** As they were set, in their own order. */
  private attributes: Attributes = {};
  /** Place in the own order of each instance that is drawn; null: the same. */
  private permutation: Uint32Array | null = null;
  private count = 0;

  constructor(kind: "spheres" | "translucent" | "sticks", shared: SharedUniforms) {
    const sticks = kind === "sticks";
    const translucent = kind === "translucent";
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: sticks ? stickVertex : sphereVertex,
      fragmentShader: sticks ? stickFragment : sphereFragment,
      uniforms: { ...shared, scale: this.scale },
      defines: translucent ? { TRANSLUCENT: 1 } : {},
      transparent: translucent,
      blending: NormalBlending,
      depthWrite: !translucent,
      side: 2,
    });
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = translucent ? 1 : 0;
    this.set({}, 0);
  }

  setScale(scale: number): void {
    this.scale.value = scale;
  }

  /** Replaces all instances. */
  set(attributes: Attributes, count: number): void {
    this.mesh.geometry.dispose();
    this.attributes = attributes;
    this.permutation = null;
    const geometry = new BufferGeometry();
    const index = new Uint32Array(6 * count);
    for (let k = 0; k < count; ++k) {
      index.set([0, 1, 2, 2, 1, 3].map((corner) => corners * k + corner), 6 * k);
    }
    geometry.setIndex(new BufferAttribute(index, 1));
    for (const [name, { array, size, normalized }] of Object.entries(attributes)) {
      const repeated = array instanceof Uint8Array ? new Uint8Array(corners * array.length) : new Float32Array(corners * array.length);
      geometry.setAttribute(name, new BufferAttribute(repeated, size, normalized ?? false));
    }
    this.mesh.geometry = geometry;
    this.mesh.visible = count > 0;
    this.count = count;
    Object.keys(attributes).forEach((name) => this.fill(name));
  }

  /** Replaces one attribute, of the same number of instances. */
  update(name: string, array: Float32Array | Uint8Array): void {
    const attribute = this.attributes[name];
    if (attribute) {
      attribute.array = array;
      this.fill(name);
    }
  }

  /** Draws the instances in this order. */
  order(permutation: Uint32Array): void {
    this.permutation = permutation;
    Object.keys(this.attributes).forEach((name) => this.fill(name));
  }

  private fill(name: string): void {
    const { array, size } = this.attributes[name]!;
    const attribute = this.mesh.geometry.getAttribute(name);
    const target = attribute.array;
    for (let to = 0; to < this.count; ++to) {
      const from = this.permutation ? this.permutation[to]! : to;
      for (let corner = 0; corner < corners; ++corner) {
        for (let c = 0; c < size; ++c) {
          target[(corners * to + corner) * size + c] = array[from * size + c]!;
        }
      }
    }
    attribute.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
