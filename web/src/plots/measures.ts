// SPDX-License-Identifier: GPL-3.0-or-later
// Figures from the data sets of a file that are known by name; further.ts draws the others.

import { listAt, numberAt, type Structure } from "../data";
import { prefixOf, printed } from "../dom";
import type { Model } from "../view/model";
import type { Plane } from "../view/settings";
import type { ChartSpec, Series } from "./chart_spec";

/** Colours of the structures, in their order. */
const colours = ["--first", "--second", "--third", "--fourth", "--fifth", "--sixth"];

export function colourOf(structure: number): string {
  return colours[structure % colours.length]!;
}

/** The name of a curve; that of the structure goes before it where there are several. */
export function named(structures: Structure[], structure: Structure, name: string): string {
  return structures.length === 1 ? name : name ? `${structure.name}: ${name}` : structure.name;
}

export const poreCurve = "/characterization/pore_curve/";
export const histogram = "/characterization/coordination_histogram";

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
    note: `Share of the void space that lies farther than r from every surface, with the mean radius r₀. Fit: 1 − erf((r/r₀ − b) / (a √2)), ${notes.join("; ")}.`,
    x: { label: "distance from the surface r / r₀" }, y: { label: "P(rₚ > r)" }, series,
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
    title: "Coordination", note: means.length === 0 ? "" : `Contacts of a particle: ${means.join("; ")}.`,
    x: { label: "contacts of a particle" }, y: { label: "share of the particles [%]" }, series,
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
    note: "Forces of the bonds that carry load, over their mean magnitude. Solid: normal force, positive under tension; dashed: magnitude of the shear force.",
    x: { label: "force over its mean magnitude" }, y: { label: "probability density", logarithmic: true }, series,
  };
}

interface Response {
  method: string;
  title: string;
  axis: string;
  unit: string;
}

const responses: Response[] = [
  { method: "frequency", title: "Moduli against frequency", axis: "frequency", unit: "Hz" },
  { method: "quasistatic", title: "Moduli against amplitude", axis: "amplitude", unit: "1" },
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
