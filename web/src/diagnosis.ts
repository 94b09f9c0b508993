// SPDX-License-Identifier: GPL-3.0-or-later
// The page of coagula diagnose: its texts and tables are there; the figures are drawn in their places.

import { pageJson } from "./data";
import { el } from "./dom";
import { Chart } from "./plots/chart";
import type { ChartSpec } from "./plots/chart_spec";
import { themeButton } from "./theme";

interface DiagnosisData {
  charts: ChartSpec[];
  causes: { name: string; probability: string }[];
}

/** One switch for each model, for all figures of data at once. */
function modelSwitches(data: DiagnosisData, charts: Chart[]): HTMLElement {
  const models = new Map<string, { colour: string; hidden: boolean; dashed: boolean }>();
  for (const series of data.charts.flatMap((spec) => spec.series)) {
    const known = data.causes.some((cause) => cause.name === series.name);
    if ((known || series.name === "base model") && !models.has(series.name)) {
      models.set(series.name, { colour: series.colour, hidden: series.hidden ?? false, dashed: series.dashed ?? false });
    }
  }
  return el("div", { class: "models", role: "group", "aria-label": "Models drawn over the data" }, ...[...models].map(([name, look]) => {
    const probability = data.causes.find((cause) => cause.name === name)?.probability;
    const box = el("input", { type: "checkbox", checked: !look.hidden, onchange: () => charts.forEach((chart) => chart.show(name, box.checked)) });
    const part = probability === undefined ? "" : ` · probability ${probability}`;
    return el("label", { class: "control check" }, box, el("i", { style: `color: var(${look.colour})`, "aria-hidden": "true" }, look.dashed ? "╌╌" : "━━"),
      el("span", {}, name, el("span", { class: "soft" }, part)));
  }));
}

function main(): void {
  const data = pageJson<DiagnosisData>();
  const charts = data.charts.map((spec) => new Chart(spec));
  for (const place of document.querySelectorAll<HTMLElement>("[data-chart]")) {
    const chart = charts[Number(place.dataset.chart)];
    if (chart) {
      place.replaceWith(chart.element);
    }
  }
  document.getElementById("models")?.replaceWith(modelSwitches(data, charts));
  document.getElementById("title")?.append(themeButton());
  document.documentElement.dataset.ready = "";
}

main();
