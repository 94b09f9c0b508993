// SPDX-License-Identifier: GPL-3.0-or-later
// What the program puts into the page: an element of JSON and a block of long arrays.

export type Numbers = Float32Array | Uint32Array | Uint8Array;

/** Where an array lies in the block. */
export interface ArrayPlace {
  type: "f32" | "u32" | "u8";
  at: number;
  count: number;
}

export type ResultValue = number | string | null | ResultValue[];

/** One data set of the file. */
export interface Result {
  path: string;
  unit: string;
  description: string;
  shape: number[];
  value: ResultValue;
}

/** One value for each particle or bond; the name of a field of bonds is the path of its data set. */
export interface Field {
  name: string;
  unit: string;
  description: string;
  values: Numbers;
  /** 3 for a vector of each particle: x, y, z of the first, then of the second ... */
  components?: number;
}

export interface Stage {
  stage: string;
  command: string;
  seed: number;
  version: string;
  time: string;
  seconds: number | null;
  positions: string;
}

/** Lengths are in units of the mean radius, `lengthUnit` metres; positions count from the lower corner of the box. */
export interface Structure {
  name: string;
  particles: number;
  /** The structure of which this is the part in the middle; null where all of it is here. */
  whole: { particles: number; periodic: boolean; lengths: [number, number, number] } | null;
  periodic: boolean;
  volumeFraction: number;
  lengthUnit: number;
  lengths: [number, number, number];
  positions: Float32Array;
  radii: Float32Array;
  bondsInFile: boolean;
  bonds: { ends: Uint32Array; branches: Float32Array } | null;
  fields: Field[];
  bondFields: Field[];
  pores: { centres: Float32Array; radii: Float32Array };
  results: Result[];
  history: Stage[];
}

export interface PageData {
  version: string;
  structures: Structure[];
}

function elementText(id: string): string {
  const element = document.getElementById(id);
  if (!element) {
    throw new Error(`the page has no element '${id}'`);
  }
  return element.textContent ?? "";
}

/** The JSON of the page. */
export function pageJson<T>(): T {
  return JSON.parse(elementText("data")) as T;
}

async function inflated(base64: string): Promise<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) {
    bytes[k] = text.charCodeAt(k);
  }
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

function arrayAt(block: ArrayBuffer, place: ArrayPlace): Numbers {
  switch (place.type) {
    case "f32":
      return new Float32Array(block, place.at, place.count);
    case "u32":
      return new Uint32Array(block, place.at, place.count);
    case "u8":
      return new Uint8Array(block, place.at, place.count);
  }
}

function isPlace(value: unknown): value is ArrayPlace {
  return typeof value === "object" && value !== null && "at" in value && "count" in value && "type" in value;
}

/** The same value with each place replaced by its array. */
function filled(value: unknown, block: ArrayBuffer): unknown {
  if (isPlace(value)) {
    return arrayAt(block, value);
  }
  if (Array.isArray(value)) {
    return value.map((entry) => filled(entry, block));
  }
  if (typeof value === "object" && value !== null) {
    return Object.fromEntries(Object.entries(value).map(([key, entry]) => [key, filled(entry, block)]));
  }
  return value;
}

export async function readPage(): Promise<PageData> {
  const block = await inflated(elementText("arrays"));
  return filled(pageJson<unknown>(), block) as PageData;
}

/** The data set at this path, if the file has it and it is a number. */
export function numberAt(structure: Structure, path: string): number | null {
  const value = structure.results.find((result) => result.path === path)?.value;
  return typeof value === "number" ? value : null;
}

/** The data set at this path, if the file has it and it is a text. */
export function textAt(structure: Structure, path: string): string | null {
  const value = structure.results.find((result) => result.path === path)?.value;
  return typeof value === "string" ? value : null;
}

/** A list of numbers; null stands for what is not finite. */
export function listAt(structure: Structure, path: string): (number | null)[] | null {
  const value = structure.results.find((result) => result.path === path)?.value;
  return Array.isArray(value) && value.every((entry) => entry === null || typeof entry === "number")
    ? (value as (number | null)[])
    : null;
}
