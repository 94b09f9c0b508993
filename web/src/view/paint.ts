// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of particles and bonds from their fields, one range for all views so that colours can be compared.

import { bulkOf, categoryColour, isSkewed, painterOf, type ColourRange, type Rgb } from "../colours";
import type { Numbers } from "../data";
import type { Painter } from "./build";
import { everything, type Model, type NamedField, type Selection } from "./model";
import type { Colouring, Settings } from "./settings";

/** What a colour bar says. */
export interface Legend {
  of: "particles" | "bonds";
  field: NamedField;
  range: ColourRange;
  /** Discrete colours with names, in place of a bar. */
  steps?: { label: string; colour: Rgb }[];
  /** How many are drawn of how many; empty where all are. */
  drawn: string;
}

const plain: Rgb = [120, 144, 176];
const plainBond: Rgb = [140, 146, 152];
const clustersShown = 6;

/** Fields of particles that some structure has, for the list of colours: by name, with a label. */
export function particleColours(models: Model[]): { value: string; label: string }[] {
  const names = new Map<string, string>([["coordination", "coordination"]]);
  for (const first of ["nonaffinity", "energy_share", "cluster"]) {
    const label = models.map((model) => model.fields.get(first)?.label).find((text) => text);
    if (label) {
      names.set(first, label);
    }
  }
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

/** Vector fields of particles that can be drawn as arrows. */
export function arrowFields(models: Model[]): { value: string; label: string }[] {
  const names = new Map(models.flatMap((model) => [...model.fields].filter(([, field]) => field.vectors.size > 0)
    .map(([name, field]): [string, string] => [name, field.label])));
  return [{ value: "none", label: "none" }].concat([...names].map(([value, label]) => ({ value, label })));
}

/** Whether a linear scale would show little of the field. */
export function wantsLogarithm(models: Model[], settings: Settings): boolean {
  return models.some((model) => {
    const values = model.field(settings.colourBy, settings.plane);
    return values !== null && !isCount(settings.colourBy) && isSkewed(values);
  });
}

function isCount(name: string): boolean {
  return name === "coordination" || name === "cluster";
}

/** One quantity of all structures: its legend, the colour of each value, and whether the value is drawn. */
interface Scale {
  legend: Legend;
  colour: (value: number) => Rgb;
  isDrawn: (value: number) => boolean;
}

function largest(lists: ArrayLike<number>[], least: number): number {
  return lists.reduce((most, list) => Array.from(list).reduce((a, b) => Math.max(a, b), most), least);
}

/** The range that the reader asks for, its ends in order, and what the values cover where nothing is asked. */
function rangeOf(lists: ArrayLike<number>[], colouring: Colouring, count: boolean, logarithmic: boolean): ColourRange {
  const signed = lists.some((list) => Array.from(list).some((value) => value < 0));
  const bulk = count ? { low: 0, high: largest(lists, 1) } : bulkOf(lists, signed, logarithmic && !signed);
  const ends = [colouring.low ?? bulk.low, colouring.high ?? bulk.high];
  const low = Math.min(...ends);
  const high = Math.max(...ends);
  return { map: colouring.map ?? (signed ? "blue-red" : "viridis"), low, high: high > low ? high : low + (Math.abs(low) || 1), logarithmic: logarithmic && low > 0 };
}

function stepsOf(name: string, range: ColourRange, models: Model[], colour: (value: number) => Rgb): { label: string; colour: Rgb }[] | undefined {
  const whole = (from: number, to: number): number[] => Array.from({ length: Math.max(0, to - from + 1) }, (_, k) => from + k);
  if (name === "cluster") {
    const sizes = models[0]?.clusterSizes ?? [];
    return [...sizes.slice(0, clustersShown).map((size, k) => ({ label: `${size} particles`, colour: colour(k + 1) })),
      { label: "without bonds", colour: colour(0) }];
  }
  const counts = whole(Math.ceil(range.low), Math.floor(range.high));
  return name === "coordination" && counts.length <= 20 ? counts.map((count) => ({ label: String(count), colour: colour(count) })) : undefined;
}

function scaleOf(of: Legend["of"], name: string, models: Model[], field: NamedField, lists: Numbers[], colouring: Colouring, logarithmic: boolean): Scale {
  const range = rangeOf(lists, colouring, of === "particles" && isCount(name), logarithmic);
  const colour = of === "particles" && name === "cluster" ? (value: number): Rgb => categoryColour(value - 1) : painterOf(range);
  const isDrawn = (value: number): boolean => !colouring.within || (value >= range.low && value <= range.high);
  const drawn = lists.reduce((sum, list) => sum + Array.from(list).filter(isDrawn).length, 0);
  const all = lists.reduce((sum, list) => sum + list.length, 0);
  return { colour, isDrawn, legend: { of, field, range, steps: of === "particles" ? stepsOf(name, range, models, colour) : undefined,
    drawn: drawn < all ? `${drawn} of ${all} ${of}` : "" } };
}

/** What one view draws and how. */
export interface Paint {
  painter: Painter;
  selection: Selection;
}

/** Particles and bonds whose values are asked for; a bond needs both its particles. */
function selectionOf(model: Model, settings: Settings, particles: Scale | null, bonds: Scale | null): Selection {
  const backbone = model.inBackbone(settings);
  const values = particles && settings.particles.within ? model.field(settings.colourBy, settings.plane) : null;
  const bondValues = bonds && settings.bondColours.within ? model.bondField(settings.bonds, settings.plane) : null;
  if (!values && !bondValues && !settings.backboneOnly) {
    return everything;
  }
  const ends = model.structure.bonds?.ends ?? new Uint32Array();
  const particle = (i: number): boolean => backbone.particle(i) && (!values || particles!.isDrawn(values[i]!));
  return { particle, bond: (k) => backbone.bond(k) && (!bondValues || bonds!.isDrawn(bondValues[k]!)) && particle(ends[2 * k]!) && particle(ends[2 * k + 1]!) };
}

function painterFor(model: Model, settings: Settings, particles: Scale | null, bonds: Scale | null): Painter {
  const values = particles ? model.field(settings.colourBy, settings.plane) : null;
  const bondValues = bonds ? model.bondField(settings.bonds, settings.plane) : null;
  const most = bonds ? Math.max(Math.abs(bonds.legend.range.low), Math.abs(bonds.legend.range.high)) : 1;
  return {
    particle: values ? (i) => particles!.colour(values[i]!) : () => plain,
    bond: bondValues ? (k) => bonds!.colour(bondValues[k]!) : () => plainBond,
    width: bondValues ? (k) => Math.min(1, Math.sqrt(Math.abs(bondValues[k]!) / most)) : () => 0.4,
  };
}

export function paint(models: Model[], settings: Settings): { paints: Paint[]; legends: Legend[] } {
  const { colourBy, plane } = settings;
  const lists = models.flatMap((model) => model.field(colourBy, plane) ?? []);
  const field = models.map((model) => model.fields.get(colourBy)).find((found) => found);
  const particles = field && lists.length > 0 ? scaleOf("particles", colourBy, models, field, lists, settings.particles, settings.logarithmic) : null;
  const bondLists = models.flatMap((model) => model.bondField(settings.bonds, plane) ?? []);
  const bondField = models.map((model) => model.bondFields.get(settings.bonds)).find((found) => found);
  const bonds = bondField && bondLists.length > 0 ? scaleOf("bonds", settings.bonds, models, bondField, bondLists, settings.bondColours, false) : null;
  const paints = models.map((model) => ({ painter: painterFor(model, settings, particles, bonds), selection: selectionOf(model, settings, particles, bonds) }));
  const legends = [settings.spheres ? particles?.legend : null, bonds?.legend];
  return { paints, legends: legends.filter((legend): legend is Legend => !!legend) };
}
