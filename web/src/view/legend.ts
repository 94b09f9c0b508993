// SPDX-License-Identifier: GPL-3.0-or-later
// Colour bars, whose range and map the reader can change.

import { gradient, mapNames, type MapName } from "../colours";
import { checkbox, el, numberInput, prefixOf, printed, select } from "../dom";
import { fullLabel } from "./model";
import type { Legend } from "./paint";
import { automatic, type Colouring } from "./settings";

/** @param change called with a new colouring. */
export function legendElement(legend: Legend, colouring: Colouring, change: (colouring: Colouring) => void): HTMLElement {
  const { range, field, of } = legend;
  const prefix = prefixOf(Math.max(Math.abs(range.low), Math.abs(range.high)), field.unit);
  const title = fullLabel(field) + (prefix.unit ? ` [${prefix.unit}]` : "") + (range.logarithmic ? ", logarithmic" : "");
  const end = (which: "low" | "high"): HTMLElement => numberInput(
    colouring[which] === null ? null : Number((colouring[which] / prefix.factor).toPrecision(12)), printed(range[which] / prefix.factor, 3), `${which === "low" ? "Lower" : "Upper"} end of the colours of the ${of}`,
    (value) => change({ ...colouring, [which]: value === null ? null : value * prefix.factor }));
  const word = (k: 0 | 1): HTMLElement => el("span", { class: "soft" }, field.signs && range.low < 0 ? field.signs[k] : "");
  const scale = legend.steps
    ? el("div", { class: "steps" }, ...legend.steps.map((step) => el("span", {},
      el("i", { style: `background: rgb(${step.colour.map(Math.round).join(",")})` }), step.label)))
    : el("div", { class: "bar" }, el("i", { style: `background: ${gradient(range.map)}` }));
  const isCategory = field.label === "cluster";
  const changed = colouring.low !== null || colouring.high !== null || colouring.map !== null || colouring.within;
  return el("figure", { class: "legend", title: field.description },
    el("figcaption", {}, title, el("span", { class: "soft drawn" }, legend.drawn ? ` · ${legend.drawn}` : "")), scale,
    el("div", { class: "edit" }, end("low"), word(0), word(1), end("high"),
      isCategory ? null : select(mapNames.map((name) => ({ value: name, label: name })), range.map, `Colour map of the ${of}`, (name) => change({ ...colouring, map: name as MapName })),
      checkbox("only these", colouring.within, (on) => change({ ...colouring, within: on }), "draw only those whose value lies in the range"),
      changed ? el("button", { type: "button", class: "quiet", "aria-label": `Range and map of the ${of} as at first`, onclick: () => change(automatic) }, "reset") : null));
}
