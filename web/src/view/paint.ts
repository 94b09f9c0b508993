// Colours of particles and bonds from their fields, one range for all views so that colours can be compared.

import { colourAt, isSkewed, placeIn, rangeOf, type ColourRange, type Rgb } from "../colours";
import { printedUnit } from "../dom";
import type { Painter } from "./build";
import type { Model } from "./model";
import type { Settings } from "./settings";

/** What a colour bar says. */
export interface Legend {
  title: string;
  unit: string;
  description: string;
  range: ColourRange;
  /** Discrete colours with names, in place of a bar. */
  steps?: { label: string; colour: Rgb }[];
}

const plain: Rgb = [120, 144, 176];
const plainBond: Rgb = [140, 146, 152];
const clustersShown = 6;

/** Fields of particles that some structure has, for the list of colours: by name, with a label. */
export function particleColours(models: Model[]): { value: string; label: string }[] {
  const names = new Map<string, string>([["coordination", "coordination"]]);
  for (const first of ["nonaffinity", "energy_share"]) {
    const label = models.map((model) => model.fields.get(first)?.label).find((text) => text);
    if (label) {
      names.set(first, label);
    }
  }
  names.set("cluster", "cluster");
  names.set("radius", "size");
  for (const model of models) {
    for (const [name, field] of model.fields) {
      if (!names.has(name)) {
        names.set(name, field.label);
      }
    }
  }
  return [...names].map(([value, label]) => ({ value, label })).concat([{ value: "plain", label: "one colour" }]);
}

export function bondColours(models: Model[]): { value: string; label: string }[] {
  const names = new Map<string, string>();
  for (const model of models) {
    for (const [name, field] of model.bondFields) {
      if (!name.startsWith("backbone")) {
        names.set(name, `coloured by ${field.label}`);
      }
    }
  }
  return [{ value: "none", label: "none" }, { value: "plain", label: "one colour" }].concat(
    [...names].map(([value, label]) => ({ value, label })));
}

/** Whether a linear scale would show little of the field. */
export function wantsLogarithm(models: Model[], settings: Settings): boolean {
  return models.some((model) => {
    const values = model.field(settings.colourBy, settings.plane);
    return values !== null && settings.colourBy !== "coordination" && isSkewed(values);
  });
}

interface Scale {
  legend: Legend | null;
  of: (model: Model) => (i: number) => Rgb;
}

function particleScale(models: Model[], settings: Settings): Scale {
  const name = settings.colourBy;
  if (name === "cluster") {
    const sizes = models[0]?.clusterSizes ?? [];
    const steps = sizes.slice(0, clustersShown).map((size, k) => ({ label: `${size} particles`, colour: colourAt("category", k) }));
    steps.push({ label: "without bonds", colour: colourAt("category", -1) });
    return {
      legend: { title: "cluster", unit: "", description: "particles that bonds join", range: { scale: "category", low: 0, high: 1, logarithmic: false }, steps },
      of: (model) => (i) => colourAt("category", model.cluster[i]!),
    };
  }
  const lists = models.flatMap((model) => model.field(name, settings.plane) ?? []);
  const field = models.map((model) => model.fields.get(name)).find((found) => found);
  if (name === "plain" || !field || lists.length === 0) {
    return { legend: null, of: () => () => plain };
  }
  const range = name === "coordination" ? countRange(lists) : rangeOf(lists, false, settings.logarithmic);
  const steps = name === "coordination" ? Array.from({ length: range.high - range.low + 1 }, (_, k) => ({
    label: String(range.low + k), colour: colourAt("amount", placeIn(range, range.low + k)) })) : undefined;
  return {
    legend: { title: field.label, unit: printedUnit(field.unit), description: field.description, range, steps },
    of: (model) => {
      const values = model.field(name, settings.plane);
      return values ? (i) => colourAt(range.scale, placeIn(range, values[i]!)) : () => plain;
    },
  };
}

function countRange(lists: ArrayLike<number>[]): ColourRange {
  const high = lists.reduce((most, list) => Array.from(list).reduce((a, b) => Math.max(a, b), most), 1);
  return { scale: "amount", low: 0, high, logarithmic: false };
}

function bondScale(models: Model[], settings: Settings): Scale & { width: (model: Model) => (k: number) => number } {
  const lists = models.flatMap((model) => model.bondField(settings.bonds, settings.plane) ?? []);
  const field = models.map((model) => model.bondFields.get(settings.bonds)).find((found) => found);
  if (!field || lists.length === 0) {
    return { legend: null, of: () => () => plainBond, width: () => () => 0.4 };
  }
  const signed = lists.some((list) => Array.from(list).some((value) => value < 0));
  const range = rangeOf(lists, signed, false);
  return {
    legend: { title: field.label, unit: printedUnit(field.unit), description: field.description, range },
    of: (model) => {
      const values = model.bondField(settings.bonds, settings.plane);
      return values ? (k) => colourAt(range.scale, placeIn(range, values[k]!)) : () => plainBond;
    },
    width: (model) => {
      const values = model.bondField(settings.bonds, settings.plane);
      return values ? (k) => Math.min(1, Math.sqrt(Math.abs(values[k]!) / range.high)) : () => 0.4;
    },
  };
}

export function paint(models: Model[], settings: Settings): { painters: Painter[]; legends: Legend[] } {
  const particles = particleScale(models, settings);
  const bonds = bondScale(models, settings);
  const painters = models.map((model) => ({ particle: particles.of(model), bond: bonds.of(model), width: bonds.width(model) }));
  const legends = [settings.spheres ? particles.legend : null, settings.bonds === "none" ? null : bonds.legend];
  return { painters, legends: legends.filter((legend): legend is Legend => legend !== null) };
}
