// SPDX-License-Identifier: GPL-3.0-or-later
// The index of a data set as a table that sorts and filters.

import { checkbox, csvField, download, el } from "./dom";
import { cellText, conditionOf, heading, isNumeric, sortedRows, unitOf, varies, type Column, type SetData } from "./set_data";

const mostRows = 500;

export class SetTable {
  readonly element: HTMLElement;
  private readonly head = el("thead");
  private readonly body = el("tbody");
  private readonly count = el("p", { class: "soft", "aria-live": "polite" });
  private readonly filters = new Map<string, string>();
  private sortedBy: Column | null = null;
  private down = false;
  private all = false;
  private chosen: number | null = null;

  /** @param filtered told the rows that pass. @param pick told the row that was clicked. */
  constructor(private readonly data: SetData, private readonly filtered: (rows: number[]) => void, private readonly pick: (row: number) => void) {
    const constant = data.columns.filter((column) => !this.isShown(column)).length;
    const more = checkbox(`also the ${constant} columns that are the same for all`, false, (on) => { this.all = on; this.drawHead(); this.drawBody(); });
    this.element = el("div", {}, el("div", { class: "tools" }, this.count, constant > 0 ? more : null,
      el("button", { type: "button", class: "quiet", onclick: () => { this.filters.clear(); this.drawHead(); this.drawBody(); this.filtered(this.rows()); } }, "clear filters"),
      el("button", { type: "button", class: "quiet csv", "aria-label": "The rows shown as CSV", onclick: () => download(`${data.name}.csv`, this.csv()) }, "CSV")),
      el("div", { class: "wide set" }, el("table", {}, this.head, this.body)));
    this.drawHead();
    this.drawBody();
  }

  /** Rows that pass all filters, in the order of the table. */
  rows(): number[] {
    const count = this.data.columns[0]?.values.length ?? 0;
    let rows = Array.from({ length: count }, (_, row) => row);
    for (const [name, text] of this.filters) {
      const column = this.data.columns.find((one) => one.name === name)!;
      const { factor } = unitOf(column);
      const passes = conditionOf(text, isNumeric(column));
      rows = passes ? rows.filter((row) => passes(column.values[row] ?? null, factor)) : rows;
    }
    return this.sortedBy ? sortedRows(rows, this.sortedBy, this.down) : rows;
  }

  choose(row: number | null): void {
    this.chosen = row;
    this.drawBody();
  }

  private isShown(column: Column): boolean {
    return this.all || column.name === "id" || varies(column);
  }

  /** In the order of the set, sentences last. */
  private shown(): Column[] {
    const columns = this.data.columns.filter((column) => this.isShown(column));
    return [...columns.filter((column) => column.name !== "message"), ...columns.filter((column) => column.name === "message")];
  }

  private sort(column: Column): void {
    this.down = this.sortedBy === column && !this.down;
    this.sortedBy = column;
    this.drawHead();
    this.drawBody();
  }

  private drawHead(): void {
    const columns = this.shown();
    this.head.replaceChildren(
      el("tr", {}, ...columns.map((column) => el("th", { class: isNumeric(column) ? "number" : undefined, title: column.description,
        "aria-sort": this.sortedBy === column ? (this.down ? "descending" : "ascending") : "none" },
        el("button", { type: "button", class: "link", onclick: () => this.sort(column) }, heading(column) + (this.sortedBy === column ? (this.down ? " ▼" : " ▲") : ""))))),
      el("tr", {}, ...columns.map((column) => el("th", {}, this.filterInput(column)))));
  }

  private filterInput(column: Column): HTMLInputElement {
    const numeric = isNumeric(column);
    const input = el("input", { type: "text", size: numeric ? 7 : 10, value: this.filters.get(column.name) ?? "", placeholder: numeric ? "> <  .." : "contains",
      "aria-label": `rows with ${column.name}`, title: numeric ? "3, >3, <=0.5 or 0.3..0.4, in the unit of the heading" : "a part of the text",
      oninput: () => {
        const text = input.value.trim();
        text === "" ? this.filters.delete(column.name) : this.filters.set(column.name, text);
        input.setAttribute("aria-invalid", String(text !== "" && conditionOf(text, numeric) === null));
        this.drawBody();
        this.filtered(this.rows());
      } });
    return input;
  }

  private drawBody(): void {
    const rows = this.rows();
    const total = this.data.columns[0]?.values.length ?? 0;
    const columns = this.shown();
    const numeric = columns.map(isNumeric);
    this.count.textContent = `${rows.length} of ${total} structures` + (rows.length > mostRows ? `; the table shows the first ${mostRows}` : "");
    this.body.replaceChildren(...rows.slice(0, mostRows).map((row) => el("tr", { class: row === this.chosen ? "chosen" : undefined, onclick: () => this.pick(row) },
      ...columns.map((column, k) => el("td", { class: numeric[k] ? "number" : undefined }, cellText(column, row))))));
  }

  private csv(): string {
    const unit = (column: Column): string => (column.unit && column.unit !== "1" ? ` [${column.unit}]` : "");
    const lines = [this.data.columns.map((column) => csvField(column.name + unit(column))),
      ...this.rows().map((row) => this.data.columns.map((column) => csvField(String(column.values[row] ?? ""))))];
    return lines.map((line) => line.join(",")).join("\n") + "\n";
  }
}
