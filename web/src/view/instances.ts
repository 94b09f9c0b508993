// Many spheres or sticks in one call of the graphics card.

import {
  BufferAttribute, Color, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, NormalBlending, RawShaderMaterial, Vector2,
  Vector4,
} from "three";
import { sphereFragment, sphereVertex, stickFragment, stickVertex } from "./shaders";

/** What all kinds share; the slab is in the space of the eye and changes with the camera. */
export interface SharedUniforms {
  slab: { value: Vector4 };
  slabRange: { value: Vector2 };
  haze: { value: Color };
  hazeRange: { value: Vector2 };
  [name: string]: { value: unknown };
}

export function sharedUniforms(): SharedUniforms {
  return {
    slab: { value: new Vector4() },
    slabRange: { value: new Vector2() },
    haze: { value: new Color(1, 1, 1) },
    hazeRange: { value: new Vector2(0, 1) },
  };
}

export type Attributes = Record<string, { array: Float32Array | Uint8Array; size: number; normalized?: boolean }>;

const corners = new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]), 3);

export class Instances {
  readonly mesh: Mesh<InstancedBufferGeometry, RawShaderMaterial>;
  private readonly scale = { value: 1 };

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
    this.mesh = new Mesh(new InstancedBufferGeometry(), material);
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
    const geometry = new InstancedBufferGeometry();
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.setAttribute("position", corners);
    for (const [name, { array, size, normalized }] of Object.entries(attributes)) {
      geometry.setAttribute(name, new InstancedBufferAttribute(array, size, normalized ?? false));
    }
    geometry.instanceCount = count;
    this.mesh.geometry = geometry;
    this.mesh.visible = count > 0;
  }

  /** Replaces one attribute, of the same number of instances. */
  update(name: string, array: Float32Array | Uint8Array): void {
    const attribute = this.mesh.geometry.getAttribute(name) as InstancedBufferAttribute | undefined;
    if (attribute) {
      attribute.array.set(array);
      attribute.needsUpdate = true;
    }
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
