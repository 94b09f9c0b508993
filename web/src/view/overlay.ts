// SPDX-License-Identifier: GPL-3.0-or-later
// What lies over a view: a tripod of the axes and a scale bar.

import type { Camera } from "three";
import { Vector3 } from "three";
import { printed, prefixOf } from "../dom";
import { colour } from "../theme";
import { axisColours, axisNames } from "./settings";

/** 1, 2 or 5 times a power of ten, not above `most`. */
export function roundLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  return power * ([5, 2, 1].find((digit) => digit * power <= most * (1 + 1e-9)) ?? 1);
}

/** A scale bar of at most a fifth of the width. @param metres of one pixel. */
export function scaleBar(width: number, metres: number): { pixels: number; label: string } {
  const length = roundLength(0.2 * width * metres);
  const prefix = prefixOf(length, "m");
  return { pixels: length / metres, label: `${printed(length / prefix.factor)} ${prefix.unit}` };
}

function font(size: number): string {
  return `${size}px ${getComputedStyle(document.body).fontFamily}`;
}

function drawTripod(context: CanvasRenderingContext2D, height: number, camera: Camera): void {
  const arm = 30;
  const [x, y] = [48, height - 46];
  const axes = axisNames.map((name, axis) => ({ name, colour: axisColours[axis]!,
    way: new Vector3().setComponent(axis, 1).transformDirection(camera.matrixWorldInverse) }));
  axes.sort((a, b) => a.way.z - b.way.z); // those that point away first
  context.lineWidth = 2.5;
  context.font = `600 ${font(13)}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const axis of axes) {
    context.strokeStyle = context.fillStyle = axis.colour;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + arm * axis.way.x, y - arm * axis.way.y);
    context.stroke();
    const seen = Math.hypot(axis.way.x, axis.way.y);
    const [dx, dy] = seen > 0.15 ? [axis.way.x / seen, axis.way.y / seen] : [-0.7, -0.7]; // an axis towards the eye has its name beside
    const away = arm * seen + 10;
    context.fillText(axis.name, x + away * dx, y - away * dy);
  }
}

function drawBar(context: CanvasRenderingContext2D, width: number, height: number, bar: { pixels: number; label: string }, where: string): void {
  const [right, y] = [width - 16, height - 18];
  context.strokeStyle = context.fillStyle = colour("--ink");
  context.lineWidth = 3;
  context.beginPath();
  context.moveTo(right - bar.pixels, y);
  context.lineTo(right, y);
  context.stroke();
  context.font = font(13);
  context.textAlign = "right";
  context.textBaseline = "bottom";
  context.fillText(bar.label + where, right, y - 4);
}

/** Draws both in a canvas of so many pixels of the style sheet. @param metres of a pixel at the target. */
export function drawOverlay(context: CanvasRenderingContext2D, width: number, height: number, camera: Camera, metres: number, parallel: boolean): void {
  drawTripod(context, height, camera);
  drawBar(context, width, height, scaleBar(width, metres), parallel ? "" : " at the centre");
}
