// SPDX-License-Identifier: GPL-3.0-or-later
// One structure in three dimensions: camera, drawing on demand, picking.

import { BoxGeometry, Color, EdgesGeometry, LineBasicMaterial, LineSegments, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { el } from "../dom";
import { colour, onTheme } from "../theme";
import { arrowInstances, bondInstances, particleInstances, poreInstances, type ParticleInstances } from "./build";
import { Eye } from "./eye";
import { Instances, sharedUniforms } from "./instances";
import type { Model } from "./model";
import { frontToBack } from "./order";
import { drawOverlay } from "./overlay";
import type { Paint } from "./paint";
import { nearestHit, slabRangeOf } from "./pick";
import type { Settings } from "./settings";

/** Without a graphics card smooth edges cost too much. */
function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

function fullResolution(): number {
  return Math.min(window.devicePixelRatio, 2);
}

/** Where the eye is, in units of half the diagonal of the box, so that views of different boxes can follow each other. */
export interface CameraState {
  position: [number, number, number];
  target: [number, number, number];
  up: [number, number, number];
}

const sortedAgain = Math.cos(0.2); // after a turn by this angle
const slowFrame = 45; // ms between frames, from which on a moving view is drawn with fewer pixels
const rest = 250; // ms without movement, after which it is drawn with all

export class Viewer {
  readonly canvas: HTMLCanvasElement;
  /** Called after the reader has moved the camera. */
  onCamera: (state: CameraState) => void = () => undefined;
  /** Called with the particle that was picked, or null. */
  onPick: (particle: number | null) => void = () => undefined;

  /** Called after every drawing. */
  onDraw: () => void = () => undefined;

  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly eye = new Eye(() => this.controls.target);
  private readonly camera = this.eye.perspective;
  private readonly controls: OrbitControls;
  private readonly overlay = el("canvas", { class: "overlay", "aria-hidden": "true" });
  private readonly shared = sharedUniforms();
  private readonly spheres = new Instances("spheres", this.shared);
  private readonly sticks = new Instances("sticks", this.shared);
  private readonly arrows = new Instances("sticks", this.shared);
  private readonly pores = new Instances("translucent", this.shared);
  private readonly frame: LineSegments<EdgesGeometry, LineBasicMaterial>;
  private readonly half: Vector3;
  private readonly size: number;
  private drawn: ParticleInstances | null = null;
  private picked: number | null = null;
  /** The instance that was clicked. */
  private hit: number | null = null;
  private pending = false;
  private sortedFrom = new Vector3();
  private resolution = 1;
  private lastFrame = 0;
  private sharpen = 0;
  private quiet = false;

  /** Throws where the browser has no WebGL 2. */
  constructor(readonly host: HTMLElement, readonly model: Model, private settings: Settings, private paint: Paint) {
    this.half = new Vector3(...model.structure.lengths).multiplyScalar(0.5);
    this.size = this.half.length();
    this.renderer = new WebGLRenderer({ antialias: !drawsInSoftware(), alpha: false, powerPreference: "high-performance" });
    this.renderer.getContext().getExtension("EXT_conservative_depth");
    this.renderer.setPixelRatio(fullResolution());
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    host.prepend(this.canvas, this.overlay);
    this.frame = new LineSegments(new EdgesGeometry(new BoxGeometry(...model.structure.lengths)), new LineBasicMaterial());
    this.scene.add(this.frame, this.spheres.mesh, this.sticks.mesh, this.arrows.mesh, this.pores.mesh);
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

  apply(settings: Settings, paint: Paint): void {
    this.settings = settings;
    this.paint = paint;
    this.rebuild();
  }

  /** New place of the slab, size of the spheres: no new instances are needed. */
  adjust(settings: Settings): void {
    this.settings = settings;
    this.spheres.setScale(settings.sphereScale);
    this.draw();
  }

  /** Shows all that is drawn, from the side of a corner or along an axis towards the eye. */
  reset(axis?: 0 | 1 | 2): void {
    const { low, high } = this.model.extent(this.settings);
    const centre = this.half.clone().multiplyScalar((low + high - 1) / this.size);
    const way = axis === undefined ? new Vector3(1.88, 1.42, 2.64) : new Vector3().setComponent(axis, 3.2);
    const position = centre.clone().addScaledVector(way, high - low);
    this.setCamera({ position: position.toArray(), target: centre.toArray(), up: [0, 1, 0] });
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
  projection(): { eye: number[]; target: number[]; up: number[]; fieldOfView: number; aspect: number; parallel: boolean; halfHeight: number } {
    const shift = (v: Vector3): number[] => v.clone().add(this.half).toArray();
    return { eye: shift(this.camera.position), target: shift(this.controls.target), up: this.camera.up.toArray(),
      fieldOfView: this.camera.fov, aspect: this.camera.aspect, parallel: this.eye.parallel, halfHeight: this.eye.halfHeight };
  }

  /** Where the picked particle is in the view, 0 to 1 from the upper left corner; null where none is picked. */
  pickedPlace(): { x: number; y: number } | null {
    const place = this.pickedInstance();
    const at = place?.project(this.eye.camera);
    return at ? { x: 0.5 + 0.5 * at.x, y: 0.5 - 0.5 * at.y } : null;
  }

  /** The centre of the image that was clicked, or of the first. */
  private pickedInstance(): Vector3 | null {
    if (this.picked === null || !this.drawn) {
      return null;
    }
    const { particle, centres } = this.drawn;
    const k = this.hit !== null && particle[this.hit] === this.picked ? this.hit : particle.indexOf(this.picked);
    return k < 0 ? null : new Vector3().fromArray(centres, 3 * k);
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

  /** Draws at once with all pixels, and says how long the graphics card took. For measurements. */
  drawNow(): number {
    const start = performance.now();
    this.pending = false;
    this.setResolution(1);
    this.render();
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits for the end
    return performance.now() - start;
  }

  /** A PNG of the view with axes and scale bar. */
  picture(): string {
    this.setResolution(1);
    this.render();
    const picture = el("canvas", { width: this.canvas.width, height: this.canvas.height });
    const context = picture.getContext("2d")!;
    context.drawImage(this.canvas, 0, 0);
    this.drawOverlay(context);
    return picture.toDataURL("image/png");
  }

  private drawOverlay(context: CanvasRenderingContext2D): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    const scale = fullResolution();
    context.setTransform(scale, 0, 0, scale, 0, 0);
    const metres = (2 * this.eye.halfHeight * this.model.structure.lengthUnit) / height;
    drawOverlay(context, width, height, this.eye.camera, metres, this.eye.parallel);
  }

  private draw(): void {
    if (!this.pending) {
      this.pending = true;
      requestAnimationFrame(() => {
        if (this.pending) {
          this.pending = false;
          this.render();
          this.adaptResolution();
        }
      });
    }
  }

  private render(): void {
    this.eye.parallel = this.shared.parallel.value = this.settings.parallel;
    this.sort();
    this.updateSlab();
    this.renderer.render(this.scene, this.eye.camera);
    if (this.host.clientHeight > 0) {
      const context = this.overlay.getContext("2d")!;
      context.resetTransform();
      context.clearRect(0, 0, this.overlay.width, this.overlay.height);
      this.drawOverlay(context);
    }
    this.onDraw();
  }

  private sort(): void {
    const toEye = this.camera.position.clone().sub(this.controls.target).normalize();
    if (this.drawn && toEye.dot(this.sortedFrom) < sortedAgain) {
      this.sortedFrom = toEye;
      this.spheres.order(frontToBack(this.drawn.centres, toEye));
    }
  }

  /** Keeps a moving view fluent on a slow graphics card. */
  private adaptResolution(): void {
    const now = performance.now();
    const since = now - this.lastFrame;
    this.lastFrame = now;
    window.clearTimeout(this.sharpen);
    if (since < 1000 && since > slowFrame) {
      this.setResolution(Math.max(0.3, 0.75 * this.resolution));
    }
    if (this.resolution < 1) {
      this.sharpen = window.setTimeout(() => {
        this.setResolution(1);
        this.render();
        this.lastFrame = 0;
      }, rest);
    }
  }

  private setResolution(part: number): void {
    if (part !== this.resolution) {
      this.resolution = part;
      this.renderer.setPixelRatio(fullResolution() * part);
    }
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width > 0 && height > 0) {
      this.renderer.setSize(width, height, true);
      this.overlay.width = Math.round(width * fullResolution());
      this.overlay.height = Math.round(height * fullResolution());
      this.eye.resize(width, height);
      this.draw();
    }
  }

  private rebuild(): void {
    const { settings, model } = this;
    this.drawn = particleInstances(model, settings, this.paint, this.half);
    this.spheres.set(this.drawn.attributes, this.drawn.particle.length);
    this.sortedFrom.set(0, 0, 0);
    this.spheres.setScale(settings.sphereScale);
    const sticks = bondInstances(model, settings, this.paint, this.half);
    this.sticks.set(sticks.attributes, sticks.count);
    const arrows = arrowInstances(model, settings, this.paint.selection, this.half);
    this.arrows.set(arrows.attributes, arrows.count);
    const pores = poreInstances(model, settings, this.half);
    this.pores.set(pores.attributes, pores.count);
    this.frame.visible = settings.box;
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
    const reach = this.size * (this.settings.images === "double" ? 3 : this.settings.images === "layer" ? 1.4 : 1);
    this.eye.update(2 * reach + this.size, 0.02 * this.size);
    const view = this.eye.camera.matrixWorldInverse;
    const normal = new Vector3().setComponent(slab.axis, 1).transformDirection(view);
    const centre = new Vector3().applyMatrix4(view);
    const [low, high] = slabRangeOf(this.settings, this.half);
    const place = normal.dot(centre);
    this.shared.slab.value.set(normal.x, normal.y, normal.z, slab.on ? 1 : 0);
    this.shared.slabRange.value.set(place + low, place + high);
    this.shared.hazeRange.value.set(-centre.z - 0.6 * this.size, -centre.z + reach);
  }

  private applyTheme(): void {
    const background = new Color(colour("--stage"));
    this.renderer.setClearColor(background);
    this.shared.haze.value = background;
    this.frame.material.color.set(colour("--soft"));
    this.draw();
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
    const { from, direction } = this.eye.ray(x, y);
    this.hit = nearestHit(this.drawn, from, direction, this.settings, this.half);
    this.select(this.hit === null ? null : this.drawn.particle[this.hit]!);
  }
}
