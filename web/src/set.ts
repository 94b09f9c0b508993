// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a data set: any two columns against each other, the table, and each structure.

import { pageJson } from "./data";
import { el, labelled, select } from "./dom";
import { Chart } from "./plots/chart";
import type { ChartSpec, Series } from "./plots/chart_spec";
import { cellText, heading, isNumeric, unitOf, varies, type Column, type SetData } from "./set_data";
import { SetTable } from "./set_table";
import { themeButton } from "./theme";

const colours = ["--first", "--second", "--third", "--fourth", "--fifth", "--sixth"];

/** What is against what. */
interface Axes {
  x: Column;
  y: Column;
  colour: Column | null;
}

/** The points of one colour, and the row of each. */
interface Points {
  series: Series;
  rows: number[];
}

/** @param columns in which the standard errors of y are looked for. */
function pointsOf(axes: Axes, rows: number[], columns: Column[]): Points[] {
  const errors = columns.find((column) => column.name === `${axes.y.name}.stderr`);
  const groups = new Map<string, number[]>();
  const drawn = rows.filter((row) => typeof axes.x.values[row] === "number" && typeof axes.y.values[row] === "number");
  for (const row of drawn) {
    const name = axes.colour ? `${axes.colour.name} ${cellText(axes.colour, row)}` : "structures";
    groups.set(name, [...(groups.get(name) ?? []), row]);
  }
  const inUnit = (column: Column, row: number): number => (column.values[row] as number) / unitOf(column).factor;
  return [...groups].map(([name, members], number) => ({
    rows: members,
    series: { name, kind: "points", colour: colours[number % colours.length]!, shape: number >= colours.length ? "triangle" : "circle",
      x: members.map((row) => inUnit(axes.x, row)), y: members.map((row) => inUnit(axes.y, row)),
      error: errors && members.map((row) => { const error = errors.values[row]; return typeof error === "number" ? error / unitOf(axes.y).factor : null; }) },
  }));
}

function specOf(axes: Axes, points: Points[], chosen: number | null): ChartSpec {
  const series = points.map((one) => one.series);
  for (const one of points) {
    const k = chosen === null ? -1 : one.rows.indexOf(chosen);
    if (k >= 0) {
      series.push({ name: "chosen", kind: "points", colour: "--ink", shape: "triangle", x: [one.series.x[k]!], y: [one.series.y[k]!] });
    }
  }
  const count = points.reduce((sum, one) => sum + one.rows.length, 0);
  return { title: `${axes.y.name} against ${axes.x.name}`, x: { label: heading(axes.x) }, y: { label: heading(axes.y) }, series, height: 420,
    note: `${count} structures that have both and pass the filters of the table. A click on a point chooses its structure.` };
}

/** The first of these columns that is there, else the one at this place. */
function preferred(columns: Column[], names: string[], place: number): Column {
  return names.map((name) => columns.find((column) => column.name === name)).find((column) => column) ?? columns[Math.min(place, columns.length - 1)]!;
}

class SetPage {
  private readonly table: SetTable;
  private readonly detail = el("section", { class: "detail", "aria-live": "polite" });
  private readonly chart: Chart | null = null;
  private readonly axes: Axes | null = null;
  private points: Points[] = [];
  private rows: number[];
  private chosen: number | null = null;

  constructor(private readonly data: SetData) {
    this.table = new SetTable(data, (rows) => { this.rows = rows; this.draw(); }, (row) => this.choose(row));
    this.rows = this.table.rows();
    const numeric = data.columns.filter((column) => isNumeric(column) && varies(column));
    if (numeric.length > 0) {
      this.axes = { x: preferred(numeric, ["doh.a", "coordination", "volume-fraction"], 0), y: preferred(numeric, ["storage_modulus.mean", "coordination"], 1),
        colour: data.columns.find((column) => column.name === "generator" && varies(column)) ?? null };
      this.points = pointsOf(this.axes, this.rows, data.columns);
      this.chart = new Chart(specOf(this.axes, this.points, null), (series, place) => this.choose(this.points[series]?.rows[place] ?? this.chosen));
    }
    const title = this.card("title");
    document.getElementById("page")!.replaceChildren(
      el("header", { class: "top" }, el("div", { class: "title" }, el("h1", {}, title || data.name), themeButton()), this.facts(title ? data.name : "")),
      ...(this.chart ? [el("div", { class: "controls" }, ...this.selects(numeric)), this.chart.element] : []),
      this.detail, el("h2", { id: "table" }, "All structures"), this.table.element,
      el("h2", { id: "sweep" }, "The sweep"), el("pre", { class: "mono" }, data.sweep),
      el("footer", { class: "soft" }, `Made by coagula ${data.version}.`));
  }

  private card(name: string): string {
    return this.data.card.find((entry) => entry.name === name)?.text ?? "";
  }

  /** The card of the set; of a long checksum its beginning. */
  private facts(file: string): HTMLElement {
    const shown = [{ name: "file", text: file }, ...this.data.card.filter(({ name }) => name !== "title")].filter(({ text }) => text !== "");
    return el("dl", { class: "facts" }, ...shown.map(({ name, text }) =>
      el("div", { title: name === "checksum" ? text : undefined }, el("dt", {}, name), el("dd", {}, name === "checksum" ? `${text.slice(0, 12)}…` : text))));
  }

  private selects(numeric: Column[]): HTMLElement[] {
    const axes = this.axes!;
    const options = numeric.map((column) => ({ value: column.name, label: heading(column) }));
    const few = this.data.columns.filter((column) => varies(column) && new Set(column.values).size <= 2 * colours.length);
    const find = (name: string): Column => this.data.columns.find((column) => column.name === name)!;
    return [
      labelled("x", select(options, axes.x.name, "x", (name) => { axes.x = find(name); this.draw(); })),
      labelled("y", select(options, axes.y.name, "y", (name) => { axes.y = find(name); this.draw(); })),
      labelled("colour", select([{ value: "", label: "none" }, ...few.map((column) => ({ value: column.name, label: column.name }))], axes.colour?.name ?? "", "colour",
        (name) => { axes.colour = name === "" ? null : find(name); this.draw(); })),
    ];
  }

  private draw(): void {
    if (this.axes && this.chart) {
      this.points = pointsOf(this.axes, this.rows, this.data.columns);
      this.chart.set(specOf(this.axes, this.points, this.chosen));
    }
  }

  private choose(row: number | null): void {
    this.chosen = row;
    this.table.choose(row);
    this.draw();
    this.detail.replaceChildren(...(row === null ? [] : this.detailOf(row)));
  }

  /** Everything about one structure, and how its view is made. */
  private detailOf(row: number): HTMLElement[] {
    const id = String(this.data.columns.find((column) => column.name === "id")?.values[row] ?? "");
    const page = `${id}.html`;
    const view = !this.data.holds ? el("p", { class: "soft" }, "The set holds no structures, only their index.")
      : el("p", {}, el("a", { href: page }, `The view of this structure`), " is a page of its own, made by ",
        el("code", {}, `coagula report ${this.data.name} --structure ${id} -o ${page}`));
    const values = this.data.columns.filter((column) => column.name !== "id" && (column.values[row] ?? null) !== null);
    return [el("h2", {}, `Structure ${id}`), view, el("dl", { class: "facts" }, ...values.map((column) =>
      el("div", { title: column.description }, el("dt", {}, column.name), el("dd", {}, `${cellText(column, row)}${unitOf(column).unit ? `\u00a0${unitOf(column).unit}` : ""}`))))];
  }
}

function main(): void {
  try {
    const page = new SetPage(pageJson<SetData>());
    Object.assign(window, { coagula: page }); // for tests and scripts
    document.documentElement.dataset.ready = "";
  } catch (error) {
    document.getElementById("page")!.replaceChildren(el("p", { class: "missing" }, `This page could not be drawn: ${String(error)}`));
    throw error;
  }
}

main();
