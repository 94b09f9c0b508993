// Colour scales. Viridis (Smith and van der Walt) for amounts and a blue-to-red scale (Moreland 2009) for signed values, both by anchors.

export type Rgb = [number, number, number];

const viridis: Rgb[] = [
  [68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [53, 183, 121], [109, 205, 89],
  [180, 222, 44], [253, 231, 37],
];
const coolWarm: Rgb[] = [
  [59, 76, 192], [98, 130, 234], [141, 176, 254], [184, 208, 249], [221, 221, 221], [245, 196, 173], [244, 154, 123], [222, 96, 77],
  [180, 4, 38],
];
/** Colours of Okabe and Ito (2008), for what has no order. */
const categories: Rgb[] = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [213, 94, 0], [240, 228, 66]];

export type ScaleName = "amount" | "signed" | "category";

function between(anchors: Rgb[], t: number): Rgb {
  const place = Math.min(Math.max(t, 0), 1) * (anchors.length - 1);
  const k = Math.min(Math.floor(place), anchors.length - 2);
  const f = place - k;
  const a = anchors[k]!;
  const b = anchors[k + 1]!;
  return [a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2])];
}

/** @param t place on the scale, 0 to 1; of categories their number. */
export function colourAt(scale: ScaleName, t: number): Rgb {
  switch (scale) {
    case "amount":
      return between(viridis, t);
    case "signed":
      return between(coolWarm, t);
    case "category":
      return t < 0 ? [150, 155, 160] : categories[t % categories.length]!;
  }
}

/** A CSS gradient of the scale, from left to right. */
export function gradient(scale: ScaleName): string {
  const anchors = scale === "signed" ? coolWarm : viridis;
  return `linear-gradient(to right, ${anchors.map((c) => `rgb(${c.join(",")})`).join(", ")})`;
}

/** How values become places on a scale. */
export interface ColourRange {
  scale: ScaleName;
  low: number;
  high: number;
  logarithmic: boolean;
}

function quantile(sorted: Float32Array, part: number): number {
  return sorted[Math.round(part * (sorted.length - 1))] ?? 0;
}

/** The range that the bulk of the values covers: their outermost hundredths take the end colours. */
export function rangeOf(lists: ArrayLike<number>[], signed: boolean, logarithmic: boolean): ColourRange {
  const values = Float32Array.from(lists.flatMap((list) => Array.from(list)).filter((v) => Number.isFinite(v) && (!logarithmic || v > 0)));
  values.sort();
  const low = quantile(values, 0.01);
  const high = quantile(values, 0.99);
  if (signed) {
    const most = Math.max(Math.abs(low), Math.abs(high)) || 1;
    return { scale: "signed", low: -most, high: most, logarithmic: false };
  }
  return { scale: "amount", low, high: high > low ? high : low + (Math.abs(low) || 1), logarithmic };
}

/** Whether a linear scale would show little: the largest values are far above the median. */
export function isSkewed(values: ArrayLike<number>): boolean {
  const sorted = Float32Array.from(Array.from(values).filter((v) => Number.isFinite(v)));
  sorted.sort();
  return quantile(sorted, 0.01) >= 0 && quantile(sorted, 0.99) > 8 * quantile(sorted, 0.5) && quantile(sorted, 0.5) > 0;
}

export function placeIn(range: ColourRange, value: number): number {
  if (range.scale === "category") {
    return value;
  }
  if (range.logarithmic) {
    return value > 0 ? Math.log(value / range.low) / Math.log(range.high / range.low) : 0;
  }
  return (value - range.low) / (range.high - range.low);
}
