// The page of coagula report.

import { numberAt, readPage, type PageData, type Structure } from "./data";
import { el, printed, quantity } from "./dom";
import { Chart, type ChartSpec } from "./plots/chart";
import { coordinationChart, forceChart, furtherCharts, poreChart, responseCharts } from "./plots/measures";
import { elasticFigure } from "./plots/surface";
import { differenceTable, history, resultTables } from "./tables";
import { themeButton } from "./theme";
import { planes } from "./view/settings";
import { Views } from "./view/views";

function facts(structure: Structure, named: boolean): HTMLElement {
  const list: [string, string][] = [
    ["particles", String(structure.particles)],
    ["box", structure.lengths.map((length) => quantity(length * structure.lengthUnit, "m")).join(" × ") + (structure.periodic ? "" : ", open")],
    ["volume fraction", printed(numberAt(structure, "/characterization/volume_fraction") ?? structure.volumeFraction)],
  ];
  const add = (name: string, path: string, unit: string): void => {
    const value = numberAt(structure, path);
    if (value !== null) {
      list.push([name, quantity(value, unit)]);
    }
  };
  add("coordination C", "/characterization/coordination", "1");
  add("heterogeneity a", "/characterization/doh/a", "1");
  for (const method of ["linear", "dem", "quasistatic"]) {
    add(`G′ ${method === "linear" ? "" : `(${method})`}`.trim(), `/mechanics/${method}/storage_modulus/mean`, "Pa");
  }
  return el("div", { class: "structure" }, named ? el("h2", {}, structure.name) : null,
    el("dl", { class: "facts" }, ...list.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value)))));
}

function header(data: PageData): HTMLElement {
  const several = data.structures.length > 1;
  return el("header", { class: "top" },
    el("div", { class: "title" }, el("h1", {}, data.structures.map((structure) => structure.name).join(" · ")), themeButton()),
    ...data.structures.map((structure) => facts(structure, several)));
}

function notes(structures: Structure[]): HTMLElement | null {
  const lines = structures.flatMap((structure) => [
    ...(structure.bondsInFile ? [] : [`${structure.name} holds no bonds; those drawn are contacts found for this page.`]),
    ...(structure.results.length === 0 ? [`${structure.name} holds no results yet; run coagula characterize and coagula shear on it.`] : []),
  ]);
  return lines.length === 0 ? null : el("div", { class: "notes" }, ...lines.map((line) => el("p", { class: "soft" }, line)));
}

function charts(specs: (ChartSpec | null)[]): HTMLElement[] {
  return specs.flatMap((spec) => (spec ? [new Chart(spec).element] : []));
}

function further(title: string, specs: ChartSpec[]): HTMLElement | null {
  return specs.length === 0 ? null : el("details", { class: "further" },
    el("summary", {}, title, el("span", { class: "soft" }, ` ${specs.length} ${specs.length === 1 ? "figure" : "figures"}`)), el("div", { class: "grid" }, ...charts(specs)));
}

function build(data: PageData): void {
  const { structures } = data;
  const page = document.getElementById("page")!;
  const figures = el("section", { class: "figures", "aria-label": "Figures" });
  const views = new Views(structures, (plane) => {
    const spec = forceChart(views.models, plane);
    if (spec) {
      forces?.set(spec);
    }
  });
  const firstForces = planes.map((plane) => forceChart(views.models, plane)).find((spec) => spec) ?? null;
  const forces = firstForces ? new Chart(firstForces) : null;
  figures.append(...charts([poreChart(structures), coordinationChart(structures)]), ...(forces ? [forces.element] : []));
  const elastic = elasticFigure(structures);
  if (elastic) {
    figures.append(elastic);
  }
  figures.append(...charts(responseCharts(structures)), ...charts(furtherCharts(structures, "/characterization")));
  const mechanics = further("Further curves of the mechanics", furtherCharts(structures, "/mechanics"));
  const more = el("main", { class: structures.length > 1 ? "several" : "one" }, views.element, figures);
  page.replaceChildren(header(data), ...[notes(structures)].filter((note) => note !== null), more,
    el("section", { class: "tables" }, ...[mechanics].filter((part) => part !== null), ...(structures.length > 1 ? [differenceTable(structures)] : []),
      el("h2", {}, "All results"), ...resultTables(structures),
      el("h2", {}, "How these files were made"), ...structures.map((structure) => history(structure, structures.length > 1))),
    el("footer", { class: "soft" }, `Made by coagula ${data.version}.`));
  Object.assign(window, { coagula: { views } });
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
