// SPDX-License-Identifier: GPL-3.0-or-later
// One view on the page: canvas, colour bars, what was picked, keyboard.

import { el, prefixOf, printed, quantity } from "../dom";
import { fullLabel, type Model, type NamedField } from "./model";
import type { Paint } from "./paint";
import type { Settings } from "./settings";
import { Viewer } from "./viewer";

const keysText = "Drag turns, the wheel or two fingers zoom, the right button shifts, a click picks a particle. Keys: arrows turn, " +
  "Shift and arrows shift, + and − zoom, X, Y and Z look along an axis, R shows all, Escape forgets the picked particle.";

export class Stage {
  readonly element: HTMLElement;
  /** Null where the browser cannot draw in three dimensions. */
  readonly viewer: Viewer | null;
  private readonly picked = el("aside", { class: "picked", "aria-live": "polite" });

  constructor(readonly model: Model, private settings: Settings, paint: Paint, named: boolean) {
    const host = el("div", { class: "canvas" });
    this.element = el("section", { class: "stage" }, host, this.picked);
    if (named) {
      this.element.append(el("h2", {}, model.structure.name));
    }
    this.viewer = this.makeViewer(host, paint);
  }

  apply(settings: Settings, paint: Paint): void {
    this.settings = settings;
    this.viewer?.apply(settings, paint);
    this.showPicked(this.viewer?.selected ?? null);
  }

  private makeViewer(host: HTMLElement, paint: Paint): Viewer | null {
    let viewer: Viewer;
    try {
      viewer = new Viewer(host, this.model, this.settings, paint);
    } catch {
      host.replaceChildren(el("p", { class: "missing" }, "This browser does not offer WebGL 2, without which the view cannot be drawn. " +
        "The figures and tables below do not need it."));
      return null;
    }
    const { structure } = this.model;
    viewer.canvas.setAttribute("role", "img");
    viewer.canvas.setAttribute("aria-label", `${structure.name}: ${structure.particles} spheres in three dimensions` +
      `${structure.bonds ? ` with ${structure.bonds.ends.length / 2} bonds` : ""}. ${keysText}`);
    viewer.canvas.title = keysText;
    viewer.canvas.addEventListener("keydown", (event) => this.key(viewer, event));
    viewer.onPick = (particle) => this.showPicked(particle);
    viewer.onDraw = () => this.placePanel();
    return viewer;
  }

  /** The panel stands in the half of the view where the picked particle is not. */
  private placePanel(): void {
    const place = this.viewer?.pickedPlace();
    if (place) {
      this.picked.classList.toggle("left", place.x > 0.5);
    }
  }

  private key(viewer: Viewer, event: KeyboardEvent): void {
    const step = 0.09;
    const shift = event.shiftKey;
    const actions: Record<string, () => void> = {
      ArrowLeft: () => viewer.move(shift ? { shiftRight: step } : { right: -step }),
      ArrowRight: () => viewer.move(shift ? { shiftRight: -step } : { right: step }),
      ArrowUp: () => viewer.move(shift ? { shiftUp: -step } : { up: step }),
      ArrowDown: () => viewer.move(shift ? { shiftUp: step } : { up: -step }),
      "+": () => viewer.move({ nearer: 1 / 1.12 }),
      "=": () => viewer.move({ nearer: 1 / 1.12 }),
      "-": () => viewer.move({ nearer: 1.12 }),
      r: () => viewer.reset(),
      x: () => viewer.reset(0),
      y: () => viewer.reset(1),
      z: () => viewer.reset(2),
      Escape: () => viewer.select(null),
    };
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (action && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      action();
    }
  }

  private showPicked(particle: number | null): void {
    this.picked.replaceChildren();
    this.picked.hidden = particle === null;
    if (particle === null) {
      return;
    }
    const { structure } = this.model;
    const metres = structure.lengthUnit;
    const centre = [0, 1, 2].map((c) => structure.positions[3 * particle + c]! * metres);
    const prefix = prefixOf(Math.max(...centre.map(Math.abs)), "m");
    const place = `${centre.map((value) => printed(value / prefix.factor)).join(", ")} ${prefix.unit}`;
    this.picked.dataset.particle = String(particle);
    const close = el("button", { type: "button", class: "quiet", "aria-label": "Forget this particle", onclick: () => this.viewer?.select(null) }, "×");
    this.picked.append(
      el("h3", {}, `Particle ${particle}`, close),
      el("dl", {}, ...[["centre", place], ["radius", quantity(structure.radii[particle]! * metres, "m")],
        ["coordination", String(this.model.field("coordination", "xy")?.[particle] ?? this.model.neighbours[particle]!.length)],
        ["cluster", this.clusterText(particle)], ...this.fieldRows(particle)].flatMap(([name, value]) => [el("dt", {}, name!), el("dd", {}, value!)])),
      this.bondTable(particle));
  }

  private clusterText(particle: number): string {
    const cluster = this.model.cluster[particle]!;
    return cluster < 0 ? "none" : `number ${cluster + 1}, of ${this.model.clusterSizes[cluster]} particles`;
  }

  private fieldRows(particle: number): string[][] {
    const above = ["radius", "coordination", "cluster"];
    return [...this.model.fields].filter(([name]) => !above.includes(name)).flatMap(([name, field]) => {
      const values = this.model.field(name, this.settings.plane);
      return values ? [[fullLabel(field), quantity(values[particle]!, field.unit)]] : [];
    });
  }

  /** Neighbours with the forces of the chosen plane. */
  private bondTable(particle: number): HTMLElement {
    const bonds = this.model.neighbours[particle]!;
    const columns = [...this.model.bondFields].filter(([name]) => !name.startsWith("backbone"))
      .flatMap(([name, field]) => {
        const values = this.model.bondField(name, this.settings.plane);
        return values ? [{ field, values }] : [];
      });
    if (bonds.length === 0) {
      return el("p", { class: "soft" }, "It has no bonds.");
    }
    const head = el("tr", {}, el("th", {}, "bond to"), ...columns.map(({ field }) => el("th", {}, field.label)));
    const rows = bonds.map(({ number, neighbour }) => el("tr", {},
      el("td", {}, el("button", { type: "button", class: "link", onclick: () => this.viewer?.select(neighbour) }, String(neighbour))),
      ...columns.map(({ field, values }) => el("td", {}, quantity(values[number]!, field.unit, 3)))));
    return el("div", {}, el("table", {}, el("thead", {}, head), el("tbody", {}, ...rows)), this.bondNote(columns.map(({ field }) => field)));
  }

  private bondNote(fields: NamedField[]): HTMLElement | null {
    const signed = fields.find((field) => field.signs);
    const perStrain = fields.some((field) => field.perStrain) ? `Forces per unit shear strain ${this.settings.plane}.` : "";
    const signs = signed ? ` Positive: ${signed.signs![1]}; negative: ${signed.signs![0]}.` : "";
    return perStrain || signs ? el("p", { class: "soft" }, perStrain + signs) : null;
  }
}
