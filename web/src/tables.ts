// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as tables: every result, what differs between structures, and how the files came to be.

import type { Result, Structure } from "./data";
import { csvField, download, el, printed, printedUnit, quantity } from "./dom";

function csvButton(name: string, rows: () => string[][]): HTMLButtonElement {
  return el("button", { type: "button", class: "quiet csv", "aria-label": "This table as CSV", onclick: () =>
    download(name, rows().map((row) => row.map(csvField).join(",")).join("\n") + "\n") }, "CSV");
}

const longestInTable = 12;

/** A value as the table shows it; null for what is too long for it. */
function valueText(result: Result | undefined): string | null {
  if (!result) {
    return "–";
  }
  if (typeof result.value === "number" || (result.value === null && result.shape.length === 0)) {
    return quantity(result.value as number | null, result.unit, 5);
  }
  if (typeof result.value === "string") {
    return result.value.includes("\n") ? null : result.value;
  }
  if (Array.isArray(result.value) && result.shape.length === 1 && result.value.length <= longestInTable) {
    const unit = printedUnit(result.unit);
    return result.value.map((value) => (typeof value === "number" ? printed(value, 4) : "–")).join(", ") + (unit ? `\u00a0${unit}` : "");
  }
  return `${result.shape.join(" × ")} numbers`;
}

function groupOf(path: string): string {
  return path.split("/").slice(1, path.startsWith("/mechanics") ? 3 : 2).join(" / ");
}

/** One row for each data set, one column for each structure; of two structures also their difference. */
export function resultTables(structures: Structure[]): HTMLElement[] {
  const maps = structures.map((structure) => new Map(structure.results.map((result) => [result.path, result])));
  const paths = [...new Set(structures.flatMap((structure) => structure.results.map((result) => result.path)))].sort();
  const groups = new Map<string, string[]>();
  for (const path of paths) {
    groups.set(groupOf(path), [...(groups.get(groupOf(path)) ?? []), path]);
  }
  return [...groups].map(([group, members]) => {
    const rows = members.flatMap((path) => {
      const found = maps.map((map) => map.get(path));
      const cells = found.map(valueText);
      const any = found.find((result) => result)!;
      return cells.every((cell) => cell === null || cell === "–") ? [] : [el("tr", {},
        el("th", { scope: "row", title: any.description }, path.split("/").slice(group.includes("/") ? 3 : 2).join(" / ").replaceAll("_", " ")),
        ...cells.map((cell) => el("td", { class: "number" }, cell ?? "a text")), el("td", { class: "soft" }, any.description))];
    });
    const csv = (): string[][] => [["data set", ...structures.map((structure) => structure.name), "unit", "description"], ...members.map((path) => {
      const found = maps.map((map) => map.get(path));
      const any = found.find((result) => result)!;
      return [path, ...found.map((result) => (result === undefined || result.value === null ? "" : typeof result.value === "object" ? JSON.stringify(result.value) : String(result.value))), any.unit, any.description];
    })];
    return el("details", { class: "results" }, el("summary", {}, group, el("span", { class: "soft" }, ` ${members.length} data sets`)),
      csvButton(`${group.replaceAll(" / ", "-")}.csv`, csv),
      el("div", { class: "wide" }, el("table", {}, el("thead", {}, el("tr", {}, el("th", {}, "result"), ...structures.map((structure) => el("th", { class: "number" }, structures.length === 1 ? "value" : structure.name)),
        el("th", {}, "meaning"))), el("tbody", {}, ...rows))));
  });
}

interface Difference {
  path: string;
  unit: string;
  description: string;
  values: (number | null)[];
}

/** Single numbers in which the structures differ. */
export function differences(structures: Structure[]): Difference[] {
  const first = structures[0]!;
  return first.results.flatMap((result) => {
    const values = structures.map((structure) => structure.results.find((other) => other.path === result.path)?.value);
    const numbers = values.map((value) => (typeof value === "number" ? value : null));
    return numbers.filter((value) => value !== null).length > 1 && numbers.some((value) => value !== null && value !== numbers[0])
      ? [{ path: result.path, unit: result.unit, description: result.description, values: numbers }] : [];
  });
}

/** Relative to the first; null where that is zero or missing. */
function relative(values: (number | null)[], k: number): number | null {
  const [a, b] = [values[0], values[k]];
  return a === null || a === undefined || b === null || b === undefined || a === 0 ? null : (b - a) / Math.abs(a);
}

/** Of several structures, each against the first. */
export function differenceTable(structures: Structure[]): HTMLElement {
  const all = differences(structures);
  const body = el("tbody", {});
  const others = structures.slice(1).map((_, k) => k + 1);
  const percent = (part: number | null): string => (part === null ? "–" : `${part > 0 ? "+" : ""}${printed(100 * part, 3)}\u00a0%`);
  const size = (row: Difference): number => Math.max(...others.map((k) => Math.abs(relative(row.values, k) ?? 0)));
  const show = (least: number, sorted: boolean): void => {
    const rows = all.filter((row) => size(row) >= least);
    if (sorted) {
      rows.sort((a, b) => size(b) - size(a));
    }
    body.replaceChildren(...rows.map((row) => el("tr", {}, el("th", { scope: "row", title: row.description }, row.path.slice(1).replaceAll("/", " / ").replaceAll("_", " ")),
      ...row.values.map((value) => el("td", { class: "number" }, quantity(value, row.unit, 5))),
      ...others.map((k) => el("td", { class: "number" }, percent(relative(row.values, k)))))));
  };
  let least = 0.01;
  let sorted = false;
  show(least, sorted);
  const names = structures.map((structure) => structure.name);
  const csv = (): string[][] => [["data set", "unit", ...names, ...others.map((k) => `${names[k]} relative to ${names[0]}`)],
    ...all.map((row) => [row.path, row.unit, ...row.values.map((value) => String(value ?? "")), ...others.map((k) => String(relative(row.values, k) ?? ""))])];
  return el("section", { class: "differences" }, el("h2", { id: "differences" }, "Differences"),
    el("div", { class: "tools" },
      el("label", { class: "control check" }, el("input", { type: "checkbox", onchange: (event: Event) => { least = (event.target as HTMLInputElement).checked ? 0 : 0.01; show(least, sorted); } }), "also below 1 %"),
      el("label", { class: "control check" }, el("input", { type: "checkbox", onchange: (event: Event) => { sorted = (event.target as HTMLInputElement).checked; show(least, sorted); } }), "largest first"),
      csvButton("differences.csv", csv)),
    el("div", { class: "wide" }, el("table", {}, el("thead", {}, el("tr", {}, el("th", {}, "result"), ...names.map((name) => el("th", { class: "number" }, name)),
      ...others.map((k) => el("th", { class: "number" }, `${others.length > 1 ? `${names[k]} ` : ""}relative`)))), body)));
}

export function history(structure: Structure, named: boolean): HTMLElement {
  const rows = structure.history.map((stage) => el("li", {}, el("code", {}, stage.command),
    el("p", { class: "soft" }, `${stage.time} · coagula ${stage.version} · ${stage.seconds === null ? "" : `${printed(stage.seconds, 3)} s`}${stage.seed >= 0 ? ` · seed ${stage.seed}` : ""}`,
      stage.positions ? el("span", { class: "hash", title: "SHA-256 of the positions that went in" }, ` · positions ${stage.positions.slice(0, 12)}…`) : null)));
  return el("div", {}, named ? el("h3", {}, structure.name) : null,
    rows.length > 0 ? el("ol", { class: "history" }, ...rows) : el("p", { class: "soft" }, "The file has no history."));
}
