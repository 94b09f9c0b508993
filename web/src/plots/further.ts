// SPDX-License-Identifier: GPL-3.0-or-later
// A figure for every list of numbers that has an axis and is not drawn elsewhere.

import { numberAt, type Result, type Structure } from "../data";
import { shownUnit } from "../dom";
import type { ChartSpec, Series } from "./chart_spec";
import { figureNames, inWords, type FigureName } from "./figure_names";
import { colourOf, histogram, named, poreCurve } from "./measures";

/** Names of what a curve is drawn against, the likeliest first. */
const abscissae = [
  "frequency", "amplitude", "strain", "dilation", "radius", "distance", "r", "wave_number", "wavenumber", "q", "length", "chord_length", "size", "edge", "edges",
  "bin_centre", "centre", "threshold", "lag", "time", "angle", "cosine", "free_volume", "volume", "value", "redundancy", "level", "shell", "order", "fraction",
];
/** No curves: edges of bins, whose middles are there too, rows of different things, and errors of what another figure shows. */
const noCurve = /\/(lower|upper|signatures)$|\/uncertainty\/|\/bonds\//;
/** Curves that would dwarf the others of their figure, or that are errors: drawn when asked for. */
const aside = /^(neighbours|vectors|per_particle|std)$|_(stderr|error)$/;
const fewest = 5; // numbers of a curve; fewer go into the table
const voigt = ["xx", "yy", "zz", "yz", "xz", "xy"];

/** A list of numbers with what it is drawn against. */
interface Entry {
  result: Result;
  structure: Structure;
  /** Number of the structure. */
  k: number;
  curves: (number | null)[][];
  axis: Axis;
}

interface Axis {
  x: number[];
  label: string;
  unit: string;
  /** One bar for each whole number. */
  counted: boolean;
}

/** Figures of one page with the folder below the group that their data sets are in. */
export interface FurtherChart {
  folder: string;
  spec: ChartSpec;
}

function folder(path: string): string {
  return path.slice(0, path.lastIndexOf("/"));
}

function lastPart(path: string): string {
  return path.slice(path.lastIndexOf("/") + 1);
}

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

/** A list that has no axis, such as the six components of a tensor, is no curve. */
function axisOf(structure: Structure, result: Result): Axis | null {
  const length = result.shape[0]!;
  const abscissa = abscissaOf(structure, result.path, length);
  if (abscissa) {
    return abscissa === result ? null
      : { x: (abscissa.value as (number | null)[]).map((value) => value ?? NaN), label: inWords(lastPart(abscissa.path)), unit: abscissa.unit, counted: false };
  }
  const width = numberAt(structure, `${folder(result.path)}/bin_width`);
  if (width !== null) {
    return { x: Array.from({ length }, (_, k) => (k + 0.5) * width), label: "value", unit: "1", counted: false };
  }
  return /\b0, 1, 2\b/.test(result.description) ? { x: Array.from({ length }, (_, k) => k), label: "number", unit: "1", counted: true } : null;
}

function withUnit(label: string, unit: string): string {
  return unit === "" ? label : `${label} [${unit}]`;
}

function sentence(text: string): string {
  return text === "" ? "" : `${text.charAt(0).toUpperCase()}${text.slice(1)}${/[.!?]$/.test(text) ? "" : "."}`;
}

const methods: Record<string, string> = { linear: "linear response", frequency: "frequency sweep", quasistatic: "quasi-static shear", compression: "uniaxial compression", dem: "explicit shear test" };

function titleOf(path: string): string {
  const text = path.split("/").slice(2).map((part) => methods[part] ?? inWords(part)).join(", ");
  return text.charAt(0).toUpperCase() + text.slice(1);
}

function sameAxis(a: Axis, b: Axis): boolean {
  return a.label === b.label && a.unit === b.unit && a.counted === b.counted;
}

/** Figures of the data sets below `group`: those of one folder, unit and axis share one. */
export function furtherCharts(structures: Structure[], group: string): FurtherChart[] {
  const found: Entry[][] = [];
  structures.forEach((structure, k) => structure.results.forEach((result) => {
    const elsewhere = result.path.startsWith(poreCurve) || result.path === histogram || noCurve.test(result.path);
    const curves = result.path.startsWith(group) && !elsewhere ? curvesOf(result) : null;
    const axis = curves ? axisOf(structure, result) : null;
    if (!curves || !axis || curves.every((curve) => curve.every((value) => value === null))) {
      return;
    }
    const entry = { result, structure, k, curves, axis };
    const others = found.find(([first]) => folder(first!.result.path) === folder(result.path) && first!.result.unit === result.unit && sameAxis(first!.axis, axis));
    others ? others.push(entry) : found.push([entry]);
  }));
  return found.map((entries) => ({ folder: folder(entries[0]!.result.path).slice(group.length + 1), spec: chartOf(structures, group, entries) }));
}

function curveName(known: FigureName | undefined, entry: Entry, column: number): string {
  const part = lastPart(entry.result.path);
  const base = part.replace(/_(stderr|error)$/, "");
  const plain = known?.curves?.[base] ?? inWords(base);
  const name = base === part ? plain : `standard error of ${plain}`;
  const component = /Voigt/.test(entry.result.description) && entry.curves.length === 6 ? voigt[column]! : String(column + 1);
  return entry.curves.length > 1 ? `${name} ${component}` : name;
}

function seriesOf(structures: Structure[], entries: Entry[], known: FigureName | undefined, scaleX: number, scaleY: number): Series[] {
  const parts = [...new Set(entries.map(({ result }) => lastPart(result.path)))];
  const hasMean = parts.includes("mean");
  return entries.flatMap((entry) => entry.curves.map((curve, c): Series => {
    const { result, structure, k, axis } = entry;
    const part = lastPart(result.path);
    const number = parts.indexOf(part) + c; // curves of one file differ by colour; of several by the kind of line, the files by colour
    return { name: named(structures, structure, curveName(known, entry, c)), kind: axis.counted ? "bars" : "line", width: 1.8,
      colour: colourOf(structures.length > 1 ? k : number), dash: structures.length > 1 ? number : 0,
      x: axis.x.map((value) => value / scaleX), y: curve.map((value) => (value === null ? null : value / scaleY)),
      hidden: (hasMean && part !== "mean") || aside.test(part) };
  }));
}

/** What the data sets say of themselves. */
function aboutOf(entries: Entry[], single: boolean): string {
  return [...new Map(entries.map(({ result }) => [lastPart(result.path), result.description]))]
    .map(([name, text]) => (single ? text : `${inWords(name)}: ${text}`)).join("; ");
}

function chartOf(structures: Structure[], group: string, entries: Entry[]): ChartSpec {
  const { result, axis } = entries[0]!;
  const known = figureNames[`${folder(result.path).slice(group.length + 1)} ${result.unit}`];
  const largest = entries.flatMap((entry) => entry.curves.flat()).reduce<number>((most, value) => Math.max(most, Math.abs(value ?? 0)), 0);
  const farthest = axis.x.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
  const up = shownUnit(largest, result.unit);
  const along = shownUnit(farthest, axis.unit);
  const single = entries.every((entry) => entry.result.path === result.path);
  const path = single ? result.path : folder(result.path);
  const positive = axis.x.every((value) => value > 0) && farthest > 50 * Math.min(...axis.x);
  return {
    title: known?.title ?? titleOf(path),
    note: known?.note ?? sentence(aboutOf(entries, single)),
    x: { label: withUnit(known?.x ?? axis.label, along.unit), logarithmic: positive && /frequency|amplitude/.test(axis.label) },
    y: { label: withUnit(known?.y ?? inWords(lastPart(path)), up.unit) },
    series: seriesOf(structures, entries, known, along.factor, up.factor),
  };
}
