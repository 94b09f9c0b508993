// One structure in three dimensions: camera, drawing on demand, picking.

import {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, EdgesGeometry, LineBasicMaterial, LineSegments, PerspectiveCamera, Scene, Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { colour, onTheme } from "../theme";
import { bondInstances, particleInstances, poreInstances, type Painter, type ParticleInstances } from "./build";
import { Instances, sharedUniforms } from "./instances";
import type { Model } from "./model";
import { nearestHit, slabRangeOf } from "./pick";
import type { Settings } from "./settings";

/** Where the eye is, in units of half the diagonal of the box, so that views of different boxes can follow each other. */
export interface CameraState {
  position: [number, number, number];
  target: [number, number, number];
  up: [number, number, number];
}

const fieldOfView = 32; // degrees

export class Viewer {
  readonly canvas: HTMLCanvasElement;
  /** Called after the reader has moved the camera. */
  onCamera: (state: CameraState) => void = () => undefined;
  /** Called with the particle that was picked, or null. */
  onPick: (particle: number | null) => void = () => undefined;

  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(fieldOfView, 1, 0.1, 1000);
  private readonly controls: OrbitControls;
  private readonly shared = sharedUniforms();
  private readonly spheres = new Instances("spheres", this.shared);
  private readonly sticks = new Instances("sticks", this.shared);
  private readonly pores = new Instances("translucent", this.shared);
  private readonly frame: LineSegments<EdgesGeometry, LineBasicMaterial>;
  private readonly axes: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly half: Vector3;
  private readonly size: number;
  private drawn: ParticleInstances | null = null;
  private picked: number | null = null;
  private pending = false;
  private quiet = false;

  /** Throws where the browser has no WebGL 2. */
  constructor(readonly host: HTMLElement, readonly model: Model, private settings: Settings, private painter: Painter) {
    this.half = new Vector3(...model.structure.lengths).multiplyScalar(0.5);
    this.size = this.half.length();
    this.renderer = new WebGLRenderer({ antialias: true, alpha: false, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    host.prepend(this.canvas);
    this.frame = new LineSegments(new EdgesGeometry(new BoxGeometry(...model.structure.lengths)), new LineBasicMaterial());
    this.axes = this.makeAxes();
    this.scene.add(this.frame, this.axes, this.spheres.mesh, this.sticks.mesh, this.pores.mesh);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.rotateSpeed = 0.9;
    this.controls.addEventListener("change", () => {
      this.draw();
      if (!this.quiet) {
        this.onCamera(this.cameraState());
      }
    });
    this.watchPointer();
    this.reset();
    new ResizeObserver(() => this.resize()).observe(host);
    onTheme(() => this.applyTheme());
    this.applyTheme();
    this.rebuild();
  }

  apply(settings: Settings, painter: Painter): void {
    this.settings = settings;
    this.painter = painter;
    this.rebuild();
  }

  /** New place of the slab, size of the spheres: no new instances are needed. */
  adjust(settings: Settings): void {
    this.settings = settings;
    this.spheres.setScale(settings.sphereScale);
    this.draw();
  }

  reset(): void {
    this.setCamera({ position: [1.76, 1.32, 2.46], target: [0, 0, 0], up: [0, 1, 0] });
    this.onCamera(this.cameraState());
  }

  cameraState(): CameraState {
    const list = (v: Vector3): [number, number, number] => [v.x / this.size, v.y / this.size, v.z / this.size];
    return { position: list(this.camera.position), target: list(this.controls.target), up: this.camera.up.toArray() };
  }

  setCamera(state: CameraState): void {
    this.quiet = true;
    this.camera.up.set(...state.up);
    this.camera.position.set(...state.position).multiplyScalar(this.size);
    this.controls.target.set(...state.target).multiplyScalar(this.size);
    this.controls.update();
    this.quiet = false;
    this.draw();
  }

  /** What a test or a script needs to find out where a particle is on the screen; lengths in units of the mean radius, from the corner of the box. */
  projection(): { eye: number[]; target: number[]; up: number[]; fieldOfView: number; aspect: number } {
    const shift = (v: Vector3): number[] => v.clone().add(this.half).toArray();
    return { eye: shift(this.camera.position), target: shift(this.controls.target), up: this.camera.up.toArray(),
      fieldOfView: this.camera.fov, aspect: this.camera.aspect };
  }

  /** Turns by angles, moves nearer by a factor, or shifts by parts of the view, for the keyboard. */
  move(turn: { right?: number; up?: number; nearer?: number; shiftRight?: number; shiftUp?: number }): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
    if (turn.right) {
      offset.applyAxisAngle(this.camera.up, turn.right);
    }
    if (turn.up) {
      const angle = offset.angleTo(this.camera.up) - turn.up;
      if (angle > 0.05 && angle < Math.PI - 0.05) {
        offset.applyAxisAngle(side, -turn.up);
      }
    }
    const shift = side.clone().multiplyScalar((turn.shiftRight ?? 0) * offset.length())
      .addScaledVector(new Vector3().crossVectors(offset, side).normalize(), (turn.shiftUp ?? 0) * offset.length());
    this.controls.target.add(shift);
    this.camera.position.copy(this.controls.target).add(offset.multiplyScalar(turn.nearer ?? 1));
    this.controls.update();
  }

  /** Marks a particle and its neighbours; null marks none. */
  select(particle: number | null): void {
    this.picked = particle;
    this.updateMarks();
    this.draw();
    this.onPick(particle);
  }

  get selected(): number | null {
    return this.picked;
  }

  /** Draws at once, and says how long the graphics card took. For measurements. */
  drawNow(): number {
    const start = performance.now();
    this.pending = false;
    this.updateSlab();
    this.renderer.render(this.scene, this.camera);
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits for the end
    return performance.now() - start;
  }

  /** A PNG of the view. */
  picture(): string {
    this.updateSlab();
    this.renderer.render(this.scene, this.camera);
    return this.canvas.toDataURL("image/png");
  }

  private draw(): void {
    if (!this.pending) {
      this.pending = true;
      requestAnimationFrame(() => {
        if (this.pending) {
          this.pending = false;
          this.updateSlab();
          this.renderer.render(this.scene, this.camera);
        }
      });
    }
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width > 0 && height > 0) {
      this.renderer.setSize(width, height, true);
      this.camera.aspect = width / height;
      // A narrow view keeps the width of a square one.
      this.camera.fov = this.camera.aspect >= 1 ? fieldOfView
        : 2 * Math.atan(Math.tan(fieldOfView * Math.PI / 360) / this.camera.aspect) * 180 / Math.PI;
      this.camera.updateProjectionMatrix();
      this.draw();
    }
  }

  private rebuild(): void {
    const { settings, model } = this;
    this.drawn = particleInstances(model, settings, this.painter, this.half);
    this.spheres.set(this.drawn.attributes, this.drawn.particle.length);
    this.spheres.setScale(settings.sphereScale);
    const sticks = bondInstances(model, settings, this.painter, this.half);
    this.sticks.set(sticks.attributes, sticks.count);
    const pores = poreInstances(model, settings, this.half);
    this.pores.set(pores.attributes, pores.count);
    this.frame.visible = settings.box;
    this.axes.visible = settings.box;
    this.updateMarks();
    this.draw();
  }

  private updateMarks(): void {
    if (!this.drawn) {
      return;
    }
    const neighbours = new Set(this.picked === null ? [] : this.model.neighbours[this.picked]!.map((bond) => bond.neighbour));
    this.spheres.update("mark", Float32Array.from(this.drawn.particle, (i) => (i === this.picked ? 2 : neighbours.has(i) ? 1 : 0)));
  }

  private updateSlab(): void {
    const { slab } = this.settings;
    this.camera.updateMatrixWorld();
    const normal = new Vector3().setComponent(slab.axis, 1).transformDirection(this.camera.matrixWorldInverse);
    const centre = new Vector3().applyMatrix4(this.camera.matrixWorldInverse);
    const [low, high] = slabRangeOf(this.settings, this.half);
    const place = normal.dot(centre);
    this.shared.slab.value.set(normal.x, normal.y, normal.z, slab.on ? 1 : 0);
    this.shared.slabRange.value.set(place + low, place + high);
    const distance = centre.length();
    const reach = this.size * (this.settings.images === "double" ? 3 : this.settings.images === "layer" ? 1.4 : 1);
    this.camera.near = Math.max(0.02 * this.size, distance - 1.5 * reach - this.size);
    this.camera.far = distance + 2 * reach + this.size;
    this.camera.updateProjectionMatrix();
    this.shared.hazeRange.value.set(distance - 0.6 * this.size, distance + reach);
  }

  private applyTheme(): void {
    const background = new Color(colour("--stage"));
    this.renderer.setClearColor(background);
    this.shared.haze.value = background;
    this.frame.material.color.set(colour("--soft"));
    this.draw();
  }

  private makeAxes(): LineSegments<BufferGeometry, LineBasicMaterial> {
    const { x, y, z } = this.half;
    const length = 0.22 * Math.min(x, y, z);
    const ends = [[length, 0, 0], [0, length, 0], [0, 0, length]];
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(ends.flatMap((end) => [-x, -y, -z, end[0]! - x, end[1]! - y, end[2]! - z])), 3));
    geometry.setAttribute("color", new BufferAttribute(Float32Array.from([1, 0.2, 0.15, 1, 0.2, 0.15, 0.1, 0.65, 0.25, 0.1, 0.65, 0.25, 0.15, 0.4, 1, 0.15, 0.4, 1]), 3));
    return new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true, depthTest: false }));
  }

  private watchPointer(): void {
    let down: { x: number; y: number } | null = null;
    this.canvas.addEventListener("pointerdown", (event) => { down = { x: event.clientX, y: event.clientY }; });
    this.canvas.addEventListener("pointerup", (event) => {
      if (down && Math.hypot(event.clientX - down.x, event.clientY - down.y) < 4 && event.button === 0) {
        const box = this.canvas.getBoundingClientRect();
        this.pickAt(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
      }
      down = null;
    });
  }

  /** @param x, y of the screen, from -1 to 1, y upwards. */
  private pickAt(x: number, y: number): void {
    if (!this.drawn || !this.settings.spheres) {
      return;
    }
    const direction = new Vector3(x, y, 0.5).unproject(this.camera).sub(this.camera.position).normalize();
    const hit = nearestHit(this.drawn, this.camera.position, direction, this.settings, this.half);
    this.select(hit === null ? null : this.drawn.particle[hit]!);
  }
}
