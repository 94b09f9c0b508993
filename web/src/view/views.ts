// SPDX-License-Identifier: GPL-3.0-or-later
// The views with their controls: one or two stages that share settings and, if wanted, the camera.

import type { Structure } from "../data";
import { checkbox, el, labelled, select, slider } from "../dom";
import { onTheme } from "../theme";
import { legendElement } from "./legend";
import { Model } from "./model";
import { arrowFields, bondColours, paint, particleColours, wantsLogarithm, type Legend } from "./paint";
import { automatic, axisNames, defaults, planes, type Plane, type Settings } from "./settings";
import { Stage } from "./stage";

export class Views {
  readonly element = el("section", { class: "views", "aria-label": "Structures in three dimensions" });
  readonly models: Model[];
  stages: Stage[] = [];
  private readonly settings: Settings = structuredClone(defaults);
  private readonly row = el("div", { class: "stages" });
  private readonly legends = el("div", { class: "legends" });
  private readonly controls = el("form", { class: "controls", "aria-label": "What the views show", onsubmit: (event: Event) => event.preventDefault() });
  private shown: number[];
  private linked = true;

  /** @param onPlane called when the reader chooses another shear plane. */
  constructor(structures: Structure[], private readonly onPlane: (plane: Plane) => void) {
    this.models = structures.map((structure) => new Model(structure));
    this.shown = this.models.slice(0, 2).map((_, k) => k);
    if (!this.models.some((model) => model.structure.bonds)) {
      this.settings.colourBy = "radius";
    }
    this.element.append(this.row, this.legends, this.controls);
    this.makeControls();
    this.makeStages();
    onTheme(() => this.refresh());
  }

  /** The settings, for tests and scripts. */
  change(settings: Partial<Settings>): void {
    const reached = this.settings.images;
    Object.assign(this.settings, settings);
    this.makeControls();
    this.refresh();
    if (this.settings.images !== reached) {
      this.showAll();
    }
  }

  private showAll(axis?: 0 | 1 | 2): void {
    this.stages.forEach((stage) => stage.viewer?.reset(axis));
  }

  private get drawn(): Model[] {
    return this.shown.map((k) => this.models[k]!);
  }

  private makeStages(): void {
    const { paints } = paint(this.drawn, this.settings);
    this.row.replaceChildren();
    this.stages = [];
    this.drawn.forEach((model, k) => {
      const stage = new Stage(model, this.settings, paints[k]!, this.models.length > 1);
      this.stages.push(stage);
      this.row.append(stage.element);
    });
    for (const stage of this.stages) {
      if (stage.viewer) {
        stage.viewer.onCamera = (state) => this.stages.forEach((other) => {
          if (this.linked && other !== stage) {
            other.viewer?.setCamera(state);
          }
        });
      }
    }
    this.refresh();
  }

  private refresh(): void {
    const { paints, legends } = paint(this.drawn, this.settings);
    this.stages.forEach((stage, k) => stage.apply(this.settings, paints[k]!));
    const focused = this.legends.contains(document.activeElement) ? document.activeElement!.getAttribute("aria-label") : null;
    this.legends.replaceChildren(...(this.stages.some((stage) => stage.viewer) ? legends.map((legend) => this.editable(legend)) : []));
    if (focused) {
      this.legends.querySelector<HTMLElement>(`[aria-label="${focused}"]`)?.focus();
    }
  }

  private editable(legend: Legend): HTMLElement {
    const key = legend.of === "particles" ? "particles" : "bondColours";
    // What is changed by leaving a field is drawn after the next one has the focus.
    return legendElement(legend, this.settings[key], (colouring) => window.setTimeout(() => this.change({ [key]: colouring })));
  }

  private adjust(): void {
    this.stages.forEach((stage) => stage.viewer?.adjust(this.settings));
  }

  private makeControls(): void {
    const hasBonds = this.models.some((model) => model.structure.bonds);
    const hasBackbone = this.models.some((model) => model.bondFields.has("backbone"));
    this.controls.replaceChildren(
      this.group("Particles", ...this.particleControls()),
      ...(hasBonds ? [this.group("Bonds", ...this.bondControls(hasBackbone))] : []),
      this.group("Space", ...this.spaceControls()),
      this.group("View", ...this.viewControls()));
  }

  private group(name: string, ...children: HTMLElement[]): HTMLElement {
    return el("fieldset", {}, el("legend", {}, name), ...children);
  }

  private particleControls(): HTMLElement[] {
    const { settings } = this;
    const logarithm = checkbox("logarithmic", settings.logarithmic, (on) => { settings.logarithmic = on; this.refresh(); });
    const colours = select(particleColours(this.models), settings.colourBy, "Colour of the particles", (value) => {
      settings.colourBy = value;
      settings.particles = automatic;
      settings.logarithmic = wantsLogarithm(this.models, settings);
      logarithm.querySelector("input")!.checked = settings.logarithmic;
      this.refresh();
    });
    const size = slider({ min: 0.1, max: 1, step: 0.01, value: settings.sphereScale, name: "Size of the spheres" }, (value) => {
      settings.sphereScale = value;
      this.adjust();
    });
    return [checkbox("spheres", settings.spheres, (on) => { settings.spheres = on; this.refresh(); }), labelled("colour", colours), logarithm,
      labelled("drawn size", size)];
  }

  private bondControls(hasBackbone: boolean): HTMLElement[] {
    const { settings } = this;
    const bonds = select(bondColours(this.models), settings.bonds, "Bonds", (value) => {
      settings.bonds = value;
      settings.bondColours = automatic;
      this.uncover(value);
      this.refresh();
    });
    const plane = select(planes.map((name) => ({ value: name, label: name })), settings.plane, "Shear plane", (value) => {
      settings.plane = value as Plane;
      this.refresh();
      this.onPlane(settings.plane);
    });
    const controls: HTMLElement[] = [labelled("bonds", bonds), labelled("shear plane", plane, "of forces, backbone, non-affinity and participation")];
    if (hasBackbone) {
      controls.push(checkbox("only the backbone", settings.backboneOnly, (on) => { settings.backboneOnly = on; this.refresh(); },
        "the fewest bonds that store 90 % of the energy under this shear"));
    }
    controls.push(...this.arrowControls());
    return controls;
  }

  /** Spheres would hide what is drawn between their centres. */
  private uncover(drawn: string): void {
    if (drawn !== "none" && this.settings.sphereScale === 1) {
      this.settings.sphereScale = 0.35;
      this.makeControls();
    }
  }

  private arrowControls(): HTMLElement[] {
    const { settings } = this;
    const fields = arrowFields(this.models);
    if (fields.length === 1) {
      return [];
    }
    const arrows = select(fields, settings.arrows, "Arrows", (value) => {
      settings.arrows = value;
      this.uncover(value);
      this.refresh();
    });
    return [labelled("arrows", arrows, "displacements of the particles under the chosen shear, enlarged"),
      labelled("length", slider({ min: 0.1, max: 5, step: 0.1, value: settings.arrowLength, name: "Length of the arrows" }, (value) => {
        settings.arrowLength = value;
        this.refresh();
      }), "of the root mean square displacement, in mean radii")];
  }

  private spaceControls(): HTMLElement[] {
    const { settings } = this;
    const { slab } = settings;
    const most = Math.max(...this.models.map((model) => model.structure.pores.radii.length));
    const controls: HTMLElement[] = [
      checkbox("slab", slab.on, (on) => { slab.on = on; this.adjust(); }),
      labelled("across", select(axisNames.map((label, k) => ({ value: String(k), label })), String(slab.axis), "Axis of the slab",
        (value) => { slab.axis = Number(value) as 0 | 1 | 2; this.adjust(); })),
      labelled("at", slider({ min: 0, max: 1, step: 0.002, value: slab.position, name: "Position of the slab" }, (value) => {
        slab.position = value; this.adjust(); })),
      labelled("thick", slider({ min: 0.01, max: 1, step: 0.01, value: slab.thickness, name: "Thickness of the slab" }, (value) => {
        slab.thickness = value; this.adjust(); })),
    ];
    if (most > 0) {
      controls.push(labelled("largest pores", slider({ min: 0, max: most, step: 1, value: settings.pores, name: "Number of largest pores" },
        (value) => { settings.pores = value; this.refresh(); }), "empty spheres that touch four particles, the largest first"));
    }
    if (this.models.some((model) => model.structure.periodic)) {
      controls.push(labelled("periodic images", select([{ value: "none", label: "none" }, { value: "layer", label: "a layer around the box" },
        { value: "double", label: "2 × 2 × 2 boxes" }], settings.images, "Periodic images", (value) => {
        settings.images = value as Settings["images"];
        this.refresh();
        this.showAll();
      })));
    }
    return controls;
  }

  private viewControls(): HTMLElement[] {
    const { settings } = this;
    const controls: HTMLElement[] = [
      checkbox("box", settings.box, (on) => { settings.box = on; this.refresh(); }),
      checkbox("orthographic", settings.parallel, (on) => { settings.parallel = on; this.refresh(); }, "without perspective: equal lengths look equal"),
      el("span", { class: "control", role: "group", "aria-label": "View along an axis" }, "along", ...axisNames.map((name, axis) =>
        el("button", { type: "button", class: "quiet", "aria-label": `View along ${name}`, onclick: () => this.showAll(axis as 0 | 1 | 2) }, name))),
      el("button", { type: "button", onclick: () => this.showAll() }, "Show all"),
      el("button", { type: "button", onclick: () => this.savePictures() }, "Save PNG"),
    ];
    if (this.shown.length > 1) {
      controls.push(checkbox("linked cameras", this.linked, (on) => { this.linked = on; }));
    }
    if (this.models.length > 2) {
      const list = this.models.map((model, k) => ({ value: String(k), label: model.structure.name }));
      this.shown.forEach((number, place) => controls.push(labelled(place === 0 ? "left" : "right",
        select(list, String(number), place === 0 ? "Left view" : "Right view", (value) => {
          this.shown[place] = Number(value);
          this.makeStages();
        }))));
    }
    return controls;
  }

  private savePictures(): void {
    for (const stage of this.stages) {
      if (stage.viewer) {
        el("a", { href: stage.viewer.picture(), download: `${stage.model.structure.name.replace(/\.h5$/, "")}.png` }).click();
      }
    }
  }
}
