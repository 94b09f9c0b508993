// Figures from the data sets of a file: those that are known by name, and every other list of numbers.

import { listAt, numberAt, type Result, type Structure } from "../data";
import { prefixOf, printed, words } from "../dom";
import type { Model } from "../view/model";
import type { Plane } from "../view/settings";
import type { ChartSpec, Series } from "./chart_spec";

/** Colours of the structures, in their order. */
const colours = ["--first", "--second", "--third", "--fourth", "--fifth", "--sixth"];

export function colourOf(structure: number): string {
  return colours[structure % colours.length]!;
}

/** The name of a curve; that of the structure goes before it where there are several. */
function named(structures: Structure[], structure: Structure, name: string): string {
  return structures.length === 1 ? name : name ? `${structure.name}: ${name}` : structure.name;
}

const poreCurve = "/characterization/pore_curve/";
const histogram = "/characterization/coordination_histogram";

export function poreChart(structures: Structure[]): ChartSpec | null {
  const series: Series[] = [];
  const notes: string[] = [];
  structures.forEach((structure, k) => {
    const radius = listAt(structure, `${poreCurve}radius`);
    const measured = listAt(structure, `${poreCurve}exclusion_probability`);
    const fit = listAt(structure, `${poreCurve}fit`);
    if (!radius || !measured) {
      return;
    }
    const x = radius.map((r) => (r ?? NaN) / structure.lengthUnit);
    series.push({ name: named(structures, structure, "exact"), kind: "line", colour: colourOf(k), x, y: measured, width: 3 });
    const a = numberAt(structure, "/characterization/doh/a");
    const b = numberAt(structure, "/characterization/doh/b");
    if (fit && a !== null && b !== null) {
      const error = numberAt(structure, "/characterization/doh/a_stderr");
      series.push({ name: named(structures, structure, "fit"), kind: "line", colour: structures.length === 1 ? "--ink" : colourOf(k), x, y: fit, dashed: true, width: 1.5 });
      notes.push(`${named(structures, structure, "")}${structures.length > 1 ? ": " : ""}a = ${printed(a)}${error === null ? "" : ` ± ${printed(error, 2)}`}, b = ${printed(b)}`);
    }
  });
  return series.length === 0 ? null : {
    title: "Pore curve",
    note: `Share of the void space farther than r from every surface. Fit: 1 − erf((r/r₀ − b) / (a √2)). ${notes.join("; ")}.`,
    x: { label: "r / r₀" }, y: { label: "P(rₚ > r)" }, series,
  };
}

export function coordinationChart(structures: Structure[]): ChartSpec | null {
  const series: Series[] = [];
  const means: string[] = [];
  structures.forEach((structure, k) => {
    const counts = listAt(structure, histogram) ?? null;
    if (!counts) {
      return;
    }
    const total = counts.reduce<number>((sum, count) => sum + (count ?? 0), 0) || 1;
    series.push({ name: named(structures, structure, structures.length === 1 ? "particles" : ""), kind: "bars", colour: colourOf(k),
      x: counts.map((_, contacts) => contacts), y: counts.map((count) => (100 * (count ?? 0)) / total) });
    const mean = numberAt(structure, "/characterization/coordination");
    if (mean !== null) {
      means.push(`${structures.length === 1 ? "mean" : structure.name} ${printed(mean)}`);
    }
  });
  return series.length === 0 ? null : {
    title: "Contact numbers", note: `Contacts of a particle: ${means.join("; ")}.`,
    x: { label: "contacts" }, y: { label: "share of the particles [%]" }, series,
  };
}

/** The rule of Rice: bins grow with the cube root of the number of values. */
function binsFor(values: number): number {
  return Math.min(64, Math.max(12, Math.round(2 * Math.cbrt(values))));
}

/** Distribution of the forces under one shear plane, over their mean magnitude. Tension and compression have opposite signs. */
export function forceChart(models: Model[], plane: Plane): ChartSpec | null {
  const structures = models.map((model) => model.structure);
  const series: Series[] = [];
  models.forEach((model, k) => {
    for (const [name, label, dashed] of [["normal_force", "normal", false], ["shear_force", "shear", true]] as const) {
      const forces = model.bondField(name, plane);
      const loaded = forces ? Float32Array.from(forces).filter((force) => force !== 0) : new Float32Array();
      if (loaded.length === 0) {
        continue;
      }
      const mean = loaded.reduce((sum, force) => sum + Math.abs(force), 0) / loaded.length;
      const sorted = loaded.map((force) => force / mean).sort();
      const [low, high] = [sorted[Math.floor(0.0005 * sorted.length)]!, sorted[Math.ceil(0.9995 * sorted.length) - 1]!];
      const bins = binsFor(sorted.length);
      const width = (high - low) / bins || 1;
      const counts = new Array<number>(bins).fill(0);
      for (const force of sorted) {
        const bin = Math.floor((force - low) / width);
        if (bin >= 0 && bin < bins) {
          ++counts[bin]!;
        }
      }
      series.push({ name: named(structures, model.structure, label), kind: "line", colour: colourOf(k), dashed,
        x: counts.map((_, bin) => low + (bin + 0.5) * width), y: counts.map((count) => count / (width * sorted.length) || null) });
    }
  });
  return series.length === 0 ? null : {
    title: `Forces in the bonds, shear ${plane}`,
    note: `Probability density of the force in a bond that carries load, over the mean magnitude. Solid: normal force; dashed: shear force (a magnitude).`,
    x: { label: "f / ⟨|f|⟩" }, y: { label: "probability density", logarithmic: true }, series,
  };
}

interface Response {
  method: string;
  title: string;
  axis: string;
  unit: string;
}

const responses: Response[] = [
  { method: "frequency", title: "Frequency response", axis: "frequency", unit: "Hz" },
  { method: "quasistatic", title: "Amplitude response", axis: "amplitude", unit: "1" },
];

/** G' and G'' against frequency or amplitude. */
export function responseCharts(structures: Structure[]): ChartSpec[] {
  return responses.flatMap(({ method, title, axis, unit }) => {
    const series: Series[] = [];
    let largest = 0;
    structures.forEach((structure, k) => {
      const group = `/mechanics/${method}/`;
      const x = listAt(structure, group + axis);
      for (const [part, label, dashed] of [["storage_modulus", "G′", false], ["loss_modulus", "G″", true]] as const) {
        const y = listAt(structure, `${group}${part}/mean`);
        if (x && y && x.length === y.length && y.some((value) => value !== null && value > 0)) {
          largest = y.reduce<number>((most, value) => Math.max(most, value ?? 0), largest);
          series.push({ name: named(structures, structure, label), kind: "line", colour: colourOf(k), dashed, x: x.map((v) => v ?? NaN), y });
        }
      }
    });
    const prefix = prefixOf(largest, "Pa");
    series.forEach((one) => { one.y = one.y.map((value) => (value === null ? null : value / prefix.factor)); });
    return series.length === 0 ? [] : [{
      title, note: "Mean of the orientations; solid: storage modulus, dashed: loss modulus.",
      x: { label: unit === "1" ? `strain ${axis}` : `${axis} [${unit}]`, logarithmic: true }, y: { label: `G′, G″ [${prefix.unit}]`, logarithmic: true }, series,
    }];
  });
}

/** Names of what a curve is drawn against, the likeliest first. */
const abscissae = [
  "frequency", "amplitude", "strain", "dilation", "radius", "distance", "r", "wave_number", "wavenumber", "q", "length", "chord_length", "size", "edge", "edges",
  "bin_centre", "centre", "threshold", "lag", "time", "angle", "cosine", "free_volume", "volume", "value", "redundancy", "level", "shell", "order", "fraction",
];
/** No curves: edges of bins, whose middles are there too, rows of different things, and errors of what another figure shows. */
const noCurve = /\/(lower|upper|signatures)$|\/uncertainty\/|\/bonds\//;
/** Curves that would dwarf the others of their figure, or that are errors: drawn when asked for. */
const aside = /^(neighbours|vectors)$|(stderr|_error)$/;
const fewest = 5; // numbers of a curve; fewer go into the table

/** A data set of numbers along one axis: [n], or [n][k] as k curves. */
function curvesOf(result: Result): (number | null)[][] | null {
  if (!Array.isArray(result.value) || (result.shape[0] ?? 0) < fewest) {
    return null;
  }
  if (result.shape.length === 1) {
    return [result.value as (number | null)[]];
  }
  const columns = result.shape[1] ?? 0;
  if (result.shape.length !== 2 || columns > 8 || columns === result.shape[0]) {
    return null;
  }
  return Array.from({ length: columns }, (_, column) => (result.value as (number | null)[][]).map((row) => row[column] ?? null));
}

function folder(path: string): string {
  return path.slice(0, path.lastIndexOf("/"));
}

function lastPart(path: string): string {
  return path.slice(path.lastIndexOf("/") + 1);
}

/** What the curves of a folder are drawn against: a list of their length there or in a folder above. */
function abscissaOf(structure: Structure, path: string, length: number): Result | null {
  for (let place = folder(path); place.length > 1; place = folder(place)) {
    const lists = structure.results.filter((result) => folder(result.path) === place && result.shape.length === 1 && result.shape[0] === length && Array.isArray(result.value));
    const found = abscissae.map((name) => lists.find((result) => lastPart(result.path) === name)).find((result) => result);
    if (found) {
      return found;
    }
  }
  return null;
}

/** Numbers of bins of one width lie at their middles. */
function places(structure: Structure, result: Result, length: number): { x: number[]; label: string; unit: string } {
  const axis = abscissaOf(structure, result.path, length);
  if (axis) {
    return { x: (axis.value as (number | null)[]).map((value) => value ?? NaN), label: words(lastPart(axis.path)), unit: axis.unit };
  }
  const width = numberAt(structure, `${folder(result.path)}/bin_width`);
  return { x: Array.from({ length }, (_, k) => (width === null ? k : (k + 0.5) * width)), label: width === null ? "number" : "value", unit: "1" };
}

function withUnit(label: string, unit: string): string {
  return unit === "" || unit === "1" ? label : `${label} [${unit}]`;
}

function title(path: string): string {
  const text = path.split("/").slice(2).map(words).join(", ");
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** A figure for each folder and unit of the data sets below `group` that no other figure shows. */
export function furtherCharts(structures: Structure[], group: string): ChartSpec[] {
  const found = new Map<string, { result: Result; structure: Structure; k: number; curves: (number | null)[][] }[]>();
  structures.forEach((structure, k) => structure.results.forEach((result) => {
    const known = result.path.startsWith(poreCurve) || result.path === histogram || noCurve.test(result.path);
    const curves = result.path.startsWith(group) && !known ? curvesOf(result) : null;
    if (curves && abscissaOf(structure, result.path, result.shape[0]!) !== result) {
      const key = `${folder(result.path)} ${result.unit}`;
      found.set(key, [...(found.get(key) ?? []), { result, structure, k, curves }]);
    }
  }));
  return [...found.values()].flatMap((entries) => chartOf(structures, entries));
}

/** Numbers of an axis between 0.01 and 10 000: by a prefix or a power of 1000 before the unit. */
function readable(largest: number, unit: string): { factor: number; unit: string } {
  const prefix = prefixOf(largest, unit);
  const power = largest > 0 ? 3 * Math.floor(Math.log10(largest / prefix.factor) / 3 + 1e-9) : 0;
  const bare = largest / prefix.factor;
  return bare === 0 || (bare >= 0.01 && bare < 1e4) ? prefix : { factor: 10 ** power, unit: `${printed(10 ** power).replace(/^1 × /, "")} ${prefix.unit}`.trim() };
}

function chartOf(structures: Structure[], entries: { result: Result; structure: Structure; k: number; curves: (number | null)[][] }[]): ChartSpec[] {
  const first = entries[0]!;
  const place = places(first.structure, first.result, first.result.shape[0]!);
  const largest = entries.flatMap((entry) => entry.curves.flat()).reduce<number>((most, value) => Math.max(most, Math.abs(value ?? 0)), 0);
  const prefix = readable(largest, first.result.unit);
  const farthest = place.x.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
  const along = prefixOf(farthest, place.unit);
  const counted = place.label === "number" && /histogram|count|distribution/.test(first.result.path);
  const hasMean = entries.some((entry) => lastPart(entry.result.path) === "mean");
  const series = entries.flatMap(({ result, structure, k, curves }) => curves.map((curve, c): Series => {
    const name = words(lastPart(result.path)) + (curves.length > 1 ? ` ${c + 1}` : "");
    const number = structures.length > 1 ? k : entries.findIndex((entry) => entry.result === result) + c;
    return { name: named(structures, structure, name), kind: counted ? "bars" : "line", colour: colourOf(number), width: 1.8,
      x: places(structure, result, curve.length).x.map((value) => value / along.factor),
      y: curve.map((value) => (value === null ? null : value / prefix.factor)), hidden: (hasMean && !name.startsWith("mean")) || aside.test(lastPart(result.path)) };
  }));
  if (series.every((one) => one.y.every((value) => value === null))) {
    return [];
  }
  const single = entries.every((entry) => entry.result.path === first.result.path);
  const about = [...new Map(entries.map(({ result }) => [lastPart(result.path), result.description]))]
    .map(([name, text]) => (single ? text : `${words(name)}: ${text}`)).join("; ");
  const positive = place.x.every((value) => value > 0) && farthest > 50 * Math.min(...place.x);
  return [{
    title: title(single ? first.result.path : folder(first.result.path)) + (single ? "" : first.result.unit === "1" ? "" : ` [${first.result.unit}]`),
    note: about === "" ? "" : `${about.charAt(0).toUpperCase()}${about.slice(1)}.`,
    x: { label: withUnit(place.label, along.unit), logarithmic: positive && (place.label === "frequency" || place.label === "amplitude") },
    y: { label: withUnit(single ? words(lastPart(first.result.path)) : words(lastPart(folder(first.result.path))), prefix.unit) }, series,
  }];
}
