// SPDX-License-Identifier: GPL-3.0-or-later
// The page of coagula report.

import { numberAt, readPage, textAt, type PageData, type Structure } from "./data";
import { el, printed, quantity, quantityWithError } from "./dom";
import { Chart } from "./plots/chart";
import type { ChartSpec } from "./plots/chart_spec";
import { sections } from "./plots/figure_names";
import { furtherCharts } from "./plots/further";
import { coordinationChart, forceChart, poreChart, responseCharts } from "./plots/measures";
import { elasticFigure } from "./plots/surface";
import { differenceTable, history, resultTables } from "./tables";
import { themeButton } from "./theme";
import { planes } from "./view/settings";
import { Views } from "./view/views";

/** "250 nm", of different sizes with their standard deviation. */
function radiusText({ radii, lengthUnit }: Structure): string {
  const mean = radii.reduce((sum, radius) => sum + radius, 0) / radii.length;
  const spread = Math.sqrt(radii.reduce((sum, radius) => sum + (radius - mean) ** 2, 0) / radii.length);
  return spread < 1e-4 * mean ? quantity(mean * lengthUnit, "m") : quantityWithError(mean * lengthUnit, spread * lengthUnit, "m");
}

interface Fact {
  name: string;
  value: string;
  meaning?: string;
}

const methods: Record<string, string> = { linear: "G′", dem: "G′, explicit", quasistatic: "G′, quasi-static" };

function factsOf(structure: Structure): Fact[] {
  const whole = structure.whole ?? structure;
  const list: Fact[] = [
    { name: "particles", value: String(whole.particles) },
    { name: "radius", value: radiusText(structure), meaning: "mean radius; ± is the standard deviation over the particles" },
    { name: "box", value: whole.lengths.map((length) => quantity(length * structure.lengthUnit, "m")).join(" × ") + (whole.periodic ? "" : ", open") },
    { name: "volume fraction", value: printed(numberAt(structure, "/characterization/volume_fraction") ?? structure.volumeFraction) },
  ];
  const add = (name: string, path: string, unit: string, error: string, meaning: string): void => {
    const value = numberAt(structure, path);
    if (value !== null) {
      const spread = numberAt(structure, error);
      list.push({ name, value: quantityWithError(value, spread, unit), meaning: spread ? meaning : undefined });
    }
  };
  add("coordination C", "/characterization/coordination", "1", "/characterization/uncertainty/coordination", "± is the standard error from sub-volumes");
  add("heterogeneity a", "/characterization/doh/a", "1", "/characterization/doh/a_stderr", "± is the standard error of the fit");
  for (const [method, name] of Object.entries(methods)) {
    const group = `/mechanics/${method}/storage_modulus/`;
    add(name, `${group}mean`, "Pa", `${group}std`, "± is the standard deviation over the orientations of this structure");
  }
  const loads = textAt(structure, "/mechanics/linear/load_structure/summary");
  if (loads?.startsWith("G' = 0")) {
    list.push({ name: "load", value: loads });
  }
  return list;
}

function facts(structure: Structure, named: boolean): HTMLElement {
  return el("div", { class: "structure" }, named ? el("h2", {}, structure.name) : null,
    el("dl", { class: "facts" }, ...factsOf(structure).map(({ name, value, meaning }) => el("div", { title: meaning }, el("dt", {}, name), el("dd", {}, value)))));
}

function header(data: PageData): HTMLElement {
  const several = data.structures.length > 1;
  return el("header", { class: "top" },
    el("div", { class: "title" }, el("h1", {}, data.structures.map((structure) => structure.name).join(" · ")), themeButton()),
    ...data.structures.map((structure) => facts(structure, several)));
}

function notes(structures: Structure[]): HTMLElement | null {
  const lines = structures.flatMap((structure) => [
    ...(structure.whole ? [`The view of ${structure.name} shows the ${structure.particles} particles in the middle of its ${structure.whole.particles}, ` +
      "and the bonds between them; figures and tables are of the whole."] : []),
    ...(structure.bondsInFile ? [] : [`${structure.name} holds no bonds; those drawn are contacts found for this page.`]),
    ...(structure.results.length === 0 ? [`${structure.name} holds no results yet; run coagula characterize and coagula shear on it.`] : []),
  ]);
  return lines.length === 0 ? null : el("div", { class: "notes" }, ...lines.map((line) => el("p", { class: "soft" }, line)));
}

/** Figures under one heading. */
interface Part {
  title: string;
  figures: HTMLElement[];
}

function drawn(specs: (ChartSpec | null)[]): HTMLElement[] {
  return specs.flatMap((spec) => (spec ? [new Chart(spec).element] : []));
}

function partsOf(structures: Structure[], forces: Chart | null): Part[] {
  const further = furtherCharts(structures, "/characterization");
  const inSection = (title: string): HTMLElement[] => drawn(further.filter(({ folder }) =>
    (sections.find((section) => section.folders.includes(folder.split("/")[0]!))?.title ?? "Other measures") === title).map(({ spec }) => spec));
  const parts = [
    { title: "Pores", figures: [...drawn([poreChart(structures)]), ...inSection("Pores")] },
    { title: "Contacts", figures: [...drawn([coordinationChart(structures)]), ...inSection("Contacts")] },
    { title: "Positions", figures: inSection("Positions") },
    { title: "Other measures", figures: inSection("Other measures") },
    { title: "Mechanics", figures: [...(forces ? [forces.element] : []), ...[elasticFigure(structures)].filter((figure) => figure !== null), ...drawn(responseCharts(structures))] },
  ];
  return parts.filter(({ figures }) => figures.length > 0);
}

function further(title: string, specs: ChartSpec[]): HTMLElement | null {
  return specs.length === 0 ? null : el("details", { class: "further", id: "further-curves" },
    el("summary", {}, title, el("span", { class: "soft" }, ` ${specs.length} ${specs.length === 1 ? "figure" : "figures"}`)), el("div", { class: "grid" }, ...drawn(specs)));
}

/** Links to every figure and table. */
function contents(parts: Part[], tables: [string, string][]): HTMLElement {
  const link = (id: string, text: string): HTMLElement => el("a", { href: `#${id}` }, text);
  const row = (title: string, links: HTMLElement[]): HTMLElement => el("li", {}, el("b", {}, title), " ", ...links.flatMap((one, k) => (k > 0 ? [" · ", one] : [one])));
  return el("nav", { class: "contents", "aria-label": "Contents" }, el("ul", {},
    ...parts.map(({ title, figures }) => row(title, figures.map((figure) => link(figure.id, (figure.querySelector("h3")?.textContent ?? title).replace(/, shear ..$/, ""))))),
    row("Tables", tables.map(([id, text]) => link(id, text)))));
}

function figuresElement(parts: Part[]): HTMLElement {
  return el("div", { class: "figures" }, ...parts.map(({ title, figures }) => el("section", { "aria-label": title }, el("h2", {}, title), el("div", { class: "grid" }, ...figures))));
}

function build(data: PageData): void {
  const { structures } = data;
  const several = structures.length > 1;
  const views = new Views(structures, (plane) => {
    const spec = forceChart(views.models, plane);
    if (spec) {
      forces?.set(spec);
    }
  });
  const firstForces = planes.map((plane) => forceChart(views.models, plane)).find((spec) => spec) ?? null;
  const forces = firstForces ? new Chart(firstForces) : null;
  const parts = partsOf(structures, forces);
  const mechanics = further("Further curves of the mechanics", furtherCharts(structures, "/mechanics").map(({ spec }) => spec));
  const hasResults = structures.some((structure) => structure.results.length > 0);
  const tables: [string, string][] = [...(mechanics ? [["further-curves", "further curves"] as [string, string]] : []), ...(several ? [["differences", "differences"] as [string, string]] : []),
    ...(hasResults ? [["all-results", "all results"] as [string, string]] : []), ["history", "how these files were made"]];
  const layout = several ? "several" : parts.length > 0 ? "one" : "bare"; // without figures the view has the whole width
  const body = [header(data), notes(structures), hasResults ? contents(parts, tables) : null,
    el("main", { class: layout }, views.element, parts.length > 0 ? figuresElement(parts) : null),
    el("section", { class: "tables" }, mechanics, several ? differenceTable(structures) : null,
      hasResults ? el("h2", { id: "all-results" }, "All results") : null, ...resultTables(structures),
      el("h2", { id: "history" }, "How these files were made"), ...structures.map((structure) => history(structure, several))),
    el("footer", { class: "soft" }, `Made by coagula ${data.version}.`)];
  document.getElementById("page")!.replaceChildren(...body.filter((part) => part !== null));
  Object.assign(window, { coagula: { views, ready: performance.now() } }); // for tests and scripts
}

async function main(): Promise<void> {
  try {
    build(await readPage());
    document.documentElement.dataset.ready = "";
  } catch (error) {
    document.getElementById("page")!.replaceChildren(el("p", { class: "missing" }, `This page could not be drawn: ${String(error)}`));
    throw error;
  }
}

void main();
