// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of values: maps by anchors, the range that they cover, and colours for what has no order.

import { colour, isDark } from "./theme";

export type Rgb = [number, number, number];

/** Viridis and inferno by Smith and van der Walt, grey, and a blue-to-red map for signed values (Moreland 2009). */
const maps = {
  "viridis": [
    [68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [53, 183, 121], [109, 205, 89],
    [180, 222, 44], [253, 231, 37],
  ],
  "inferno": [
    [0, 0, 4], [27, 12, 66], [75, 12, 107], [120, 28, 109], [165, 44, 96], [207, 68, 70], [237, 105, 37], [251, 155, 6], [247, 209, 61],
    [252, 255, 164],
  ],
  "grey": [[30, 30, 30], [245, 245, 245]],
  "blue-red": [
    [59, 76, 192], [98, 130, 234], [141, 176, 254], [184, 208, 249], [221, 221, 221], [245, 196, 173], [244, 154, 123], [222, 96, 77],
    [180, 4, 38],
  ],
} satisfies Record<string, Rgb[]>;

export type MapName = keyof typeof maps;
export const mapNames = Object.keys(maps) as MapName[];

/** Colours of Okabe and Ito (2008), for what has no order. */
const categories: Rgb[] = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [213, 94, 0], [240, 228, 66]];

/** @param rank from 0; negative for what belongs to no category. */
export function categoryColour(rank: number): Rgb {
  return rank < 0 ? [150, 155, 160] : categories[rank % categories.length]!;
}

function between(anchors: Rgb[], t: number): Rgb {
  const place = Math.min(Math.max(t, 0), 1) * (anchors.length - 1);
  const k = Math.min(Math.floor(place), anchors.length - 2);
  const f = place - k;
  const a = anchors[k]!;
  const b = anchors[k + 1]!;
  return [a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2])];
}

/** Relative luminance of the Web Content Accessibility Guidelines. */
function luminance(rgb: Rgb): number {
  const [r, g, b] = rgb.map((part) => (part <= 10 ? part / 3294 : ((part / 255 + 0.055) / 1.055) ** 2.4)) as Rgb;
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function hexColour(text: string): Rgb {
  return [1, 3, 5].map((place) => parseInt(text.slice(place, place + 2), 16)) as Rgb;
}

/** A map from dark to light starts on a dark background where it can be told from that. */
function firstPlace(map: MapName): number {
  const visible = 2.3; // contrast
  if (!isDark() || map === "blue-red") {
    return 0;
  }
  const background = luminance(hexColour(colour("--stage"))) + 0.05;
  let t = 0;
  while (t < 1 && luminance(between(maps[map], t)) + 0.05 < visible * background) {
    t += 0.01;
  }
  return t;
}

/** The colours of a map by the place on it, 0 to 1, on the present background. */
export function coloursOf(map: MapName): (t: number) => Rgb {
  const first = firstPlace(map);
  return (t) => between(maps[map], first + (1 - first) * Math.min(Math.max(t, 0), 1));
}

/** A CSS gradient of the map, from left to right. */
export function gradient(map: MapName): string {
  const colours = coloursOf(map);
  return `linear-gradient(to right, ${Array.from({ length: 17 }, (_, k) => `rgb(${colours(k / 16).map(Math.round).join(",")})`).join(", ")})`;
}

/** How values become places on a map. */
export interface ColourRange {
  map: MapName;
  low: number;
  high: number;
  logarithmic: boolean;
}

function quantile(sorted: Float32Array, part: number): number {
  return sorted[Math.round(part * (sorted.length - 1))] ?? 0;
}

/** The range that the bulk of the values covers: their outermost hundredths take the end colours. Signed values have zero in the middle. */
export function bulkOf(lists: ArrayLike<number>[], signed: boolean, logarithmic: boolean): { low: number; high: number } {
  const values = Float32Array.from(lists.flatMap((list) => Array.from(list)).filter((v) => Number.isFinite(v) && (!logarithmic || v > 0)));
  values.sort();
  const low = quantile(values, 0.01);
  const high = quantile(values, 0.99);
  if (signed) {
    const most = Math.max(Math.abs(low), Math.abs(high)) || 1;
    return { low: -most, high: most };
  }
  return { low, high: high > low ? high : low + (Math.abs(low) || 1) };
}

/** Whether a linear scale would show little: the largest values are far above the median. */
export function isSkewed(values: ArrayLike<number>): boolean {
  const sorted = Float32Array.from(Array.from(values).filter((v) => Number.isFinite(v)));
  sorted.sort();
  return quantile(sorted, 0.01) >= 0 && quantile(sorted, 0.99) > 8 * quantile(sorted, 0.5) && quantile(sorted, 0.5) > 0;
}

/** Place of a value on the map, 0 to 1 within the range. */
function placeIn(range: ColourRange, value: number): number {
  if (range.logarithmic) {
    return value > 0 ? Math.log(value / range.low) / Math.log(range.high / range.low) : 0;
  }
  return (value - range.low) / (range.high - range.low);
}

/** Colours of values. */
export function painterOf(range: ColourRange): (value: number) => Rgb {
  const colours = coloursOf(range.map);
  return (value) => colours(placeIn(range, value));
}
