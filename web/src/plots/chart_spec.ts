// SPDX-License-Identifier: GPL-3.0-or-later
// What a figure shows, and the same as a table and in words.

import { csvField, printed } from "../dom";

export interface Series {
  name: string;
  kind: "line" | "points" | "bars";
  /** A colour of the style sheet, such as "--first". */
  colour: string;
  x: number[];
  y: (number | null)[];
  /** One standard deviation of each y. */
  error?: (number | null)[];
  /** Points that are drawn open, such as held-out data. */
  open?: boolean[];
  shape?: "circle" | "triangle";
  dashed?: boolean;
  /** Number of the kind of line where curves of one colour differ by it; 0 is solid. */
  dash?: number;
  width?: number;
  hidden?: boolean;
}

export interface Axis {
  label: string;
  logarithmic?: boolean;
}

export interface ChartSpec {
  title: string;
  /** HTML-free text below the figure. */
  note?: string;
  x: Axis;
  y: Axis;
  series: Series[];
  /** Lines across the figure at values of x, with a word. */
  marks?: { x: number; label: string; colour: string }[];
  /** A grey band between two values of y. */
  band?: [number, number];
  height?: number;
  /** Symmetric about zero, such as residuals. */
  zero?: boolean;
}

export interface Table {
  x: number[];
  columns: (number | null)[][];
  /** Place in its own arrays of each entry of a column; -1 where there is none. */
  origin: Int32Array[];
}

/** All series on one list of x. Several points of a series at one x keep places of their own. */
export function joined(series: Series[]): Table {
  const entries = series.flatMap((one, s) => one.x.map((x, k) => ({ x, s, k }))).filter(({ x }) => Number.isFinite(x));
  entries.sort((a, b) => a.x - b.x || a.k - b.k || a.s - b.s);
  const x: number[] = [];
  const places: number[][] = [];
  let group = 0; // first row with the present x
  for (const entry of entries) {
    if (x.length === 0 || x[x.length - 1] !== entry.x) {
      group = x.length;
    }
    let row = group;
    while (row < x.length && places[row]![entry.s] !== undefined) {
      ++row;
    }
    if (row === x.length) {
      x.push(entry.x);
      places.push([]);
    }
    places[row]![entry.s] = entry.k;
  }
  const origin = series.map((_, s) => Int32Array.from(places, (place) => place[s] ?? -1));
  const columns = series.map((one, s) => Array.from(origin[s]!, (k) => (k < 0 ? null : (one.y[k] ?? null))));
  return { x, columns, origin };
}

/** The numbers of a figure as a table; errors beside their values. */
export function csvOf(spec: ChartSpec): string {
  const table = joined(spec.series);
  const head = [spec.x.label, ...spec.series.flatMap((one) => [one.name, ...(one.error ? [`${one.name}: standard deviation`] : []),
    ...(one.open?.some((open) => open) ? [`${one.name}: held out`] : [])])];
  const rows = table.x.map((x, row) => [x, ...spec.series.flatMap((one, s) => {
    const k = table.origin[s]![row]!;
    return [table.columns[s]![row] ?? "", ...(one.error ? [k < 0 ? "" : (one.error[k] ?? "")] : []),
      ...(one.open?.some((open) => open) ? [k < 0 ? "" : Number(one.open[k] ?? false)] : [])];
  })]);
  return [head.map(csvField), ...rows].map((row) => row.join(",")).join("\n") + "\n";
}

/** The figure in words, for those who cannot see it. */
export function described(spec: ChartSpec): string {
  const ranges = spec.series.map((one) => {
    const values = one.y.filter((value): value is number => value !== null && Number.isFinite(value));
    return values.length === 0 ? `${one.name} has no values`
      : `${one.name}: ${values.length} values from ${printed(least(values))} to ${printed(most(values))}`;
  });
  return `${spec.title}. ${spec.y.label} against ${spec.x.label}. ${ranges.join("; ")}.`;
}

function least(values: number[]): number {
  return values.reduce((a, b) => Math.min(a, b), Infinity);
}

function most(values: number[]): number {
  return values.reduce((a, b) => Math.max(a, b), -Infinity);
}
