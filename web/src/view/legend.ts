// Colour bars.

import { gradient } from "../colours";
import { el, printed } from "../dom";
import type { Legend } from "./paint";

export function legendElement(legend: Legend): HTMLElement {
  const { range } = legend;
  const title = legend.title + (legend.unit ? ` [${legend.unit}]` : "") + (range.logarithmic ? ", logarithmic" : "");
  const scale = legend.steps
    ? el("div", { class: "steps" }, ...legend.steps.map((step) => el("span", {},
      el("i", { style: `background: rgb(${step.colour.map(Math.round).join(",")})` }), step.label)))
    : el("div", { class: "bar" }, el("i", { style: `background: ${gradient(range.scale)}` }),
      el("span", {}, printed(range.low, 3)), el("span", {}, printed(range.high, 3)));
  return el("figure", { class: "legend", title: legend.description }, el("figcaption", {}, title), scale);
}
