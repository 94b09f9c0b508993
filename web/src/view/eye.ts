// SPDX-License-Identifier: GPL-3.0-or-later
// The two cameras of a view. Controls move the one with perspective; the parallel one follows it and shows the same at its target.

import { OrthographicCamera, PerspectiveCamera, Vector3 } from "three";

const fieldOfView = 32; // degrees

export class Eye {
  readonly perspective = new PerspectiveCamera(fieldOfView, 1, 0.1, 1000);
  private readonly orthographic = new OrthographicCamera();
  parallel = false;

  /** @param target where the eye looks. */
  constructor(private readonly target: () => Vector3) {}

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.parallel ? this.orthographic : this.perspective;
  }

  get distance(): number {
    return this.perspective.position.distanceTo(this.target());
  }

  /** Half the height of the view at the target. */
  get halfHeight(): number {
    return this.distance * Math.tan((this.perspective.fov * Math.PI) / 360);
  }

  resize(width: number, height: number): void {
    const aspect = width / height;
    this.perspective.aspect = aspect;
    // A narrow view keeps the width of a square one.
    this.perspective.fov = aspect >= 1 ? fieldOfView : (2 * Math.atan(Math.tan((fieldOfView * Math.PI) / 360) / aspect) * 180) / Math.PI;
    this.perspective.updateProjectionMatrix();
  }

  /** Sets what is drawn in front of and behind the target. @param reach of the structure about the target. */
  update(reach: number, least: number): void {
    const { perspective, orthographic, distance } = this;
    perspective.near = Math.max(least, distance - reach);
    perspective.far = distance + reach;
    perspective.updateProjectionMatrix();
    perspective.updateMatrixWorld();
    const height = this.halfHeight;
    orthographic.position.copy(perspective.position);
    orthographic.quaternion.copy(perspective.quaternion);
    orthographic.top = height;
    orthographic.bottom = -height;
    orthographic.right = height * perspective.aspect;
    orthographic.left = -orthographic.right;
    orthographic.near = distance - reach;
    orthographic.far = distance + reach;
    orthographic.updateProjectionMatrix();
    orthographic.updateMatrixWorld();
  }

  /** The ray through a place on the screen. @param x, y from -1 to 1, y upwards. */
  ray(x: number, y: number): { from: Vector3; direction: Vector3 } {
    const { camera } = this;
    const near = new Vector3(x, y, -1).unproject(camera);
    const direction = this.parallel ? camera.getWorldDirection(new Vector3()) : near.clone().sub(camera.position).normalize();
    return { from: this.parallel ? near : camera.position.clone(), direction };
  }
}
