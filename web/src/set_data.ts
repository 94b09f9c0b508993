// SPDX-License-Identifier: GPL-3.0-or-later
// The index of a data set as the program puts it into the page, and what readers ask of its columns.

import { printed, printedUnit, shownUnit } from "./dom";

export type Cell = number | string | null;

/** One value for each structure; null where it has none. */
export interface Column {
  name: string;
  unit: string;
  description: string;
  values: Cell[];
}

export interface SetData {
  version: string;
  name: string;
  /** Whether the file holds the structures, not only their index. */
  holds: boolean;
  card: { name: string; text: string }[];
  sweep: string;
  columns: Column[];
}

export function isNumeric(column: Column): boolean {
  return column.values.some((value) => typeof value === "number") && column.values.every((value) => typeof value !== "string");
}

/** Whether structures differ in it. */
export function varies(column: Column): boolean {
  return new Set(column.values).size > 1;
}

/** The unit in which the whole column is easy to read, and the factor to divide by. */
export function unitOf(column: Column): { factor: number; unit: string } {
  const largest = column.values.reduce<number>((most, value) => (typeof value === "number" ? Math.max(most, Math.abs(value)) : most), 0);
  return column.unit === "1" ? { factor: 1, unit: printedUnit(column.unit) } : shownUnit(largest, column.unit);
}

export function heading(column: Column): string {
  const { unit } = unitOf(column);
  return unit ? `${column.name} [${unit}]` : column.name;
}

/** A value in the unit of its column. */
export function cellText(column: Column, row: number): string {
  const value = column.values[row] ?? null;
  return typeof value === "number" ? printed(value / unitOf(column).factor, 5) : (value ?? "–");
}

/** What a filter asks of a value in the unit shown: "3", ">3", "<= 0.5", "0.3..0.4" of a number, a part of a text. Null: not understood. */
export function conditionOf(text: string, numeric: boolean): ((value: Cell, factor: number) => boolean) | null {
  const wanted = text.trim();
  if (!numeric) {
    return (value) => String(value ?? "").toLowerCase().includes(wanted.toLowerCase());
  }
  const number = "([-+−]?[0-9.]+(?:e[-+]?[0-9]+)?)";
  const read = (part: string): number => Number(part.replace("−", "-"));
  const shown = (value: Cell, factor: number): number => (typeof value === "number" ? value / factor : NaN);
  const between = new RegExp(`^${number}\\s*\\.\\.\\s*${number}$`, "i").exec(wanted);
  if (between) {
    const [low, high] = [read(between[1]!), read(between[2]!)];
    return (value, factor) => shown(value, factor) >= low && shown(value, factor) <= high;
  }
  const compared = new RegExp(`^(<=|>=|<|>|=)?\\s*${number}$`, "i").exec(wanted);
  if (!compared) {
    return null;
  }
  const limit = read(compared[2]!);
  const close = (a: number): boolean => Math.abs(a - limit) <= 5e-5 * Math.abs(limit);
  switch (compared[1]) {
    case "<": return (value, factor) => shown(value, factor) < limit;
    case "<=": return (value, factor) => shown(value, factor) <= limit;
    case ">": return (value, factor) => shown(value, factor) > limit;
    case ">=": return (value, factor) => shown(value, factor) >= limit;
    default: return (value, factor) => close(shown(value, factor));
  }
}

/** Rows in the order of a column; those without a value last. */
export function sortedRows(rows: number[], column: Column, down: boolean): number[] {
  const sign = down ? -1 : 1;
  return [...rows].sort((a, b) => {
    const [one, other] = [column.values[a] ?? null, column.values[b] ?? null];
    if (one === null || other === null) {
      return one === other ? a - b : one === null ? 1 : -1;
    }
    const order = typeof one === "number" && typeof other === "number" ? one - other : String(one).localeCompare(String(other));
    return sign * order || a - b;
  });
}
