// SPDX-License-Identifier: GPL-3.0-or-later
// The moduli in every direction as surfaces: the distance from the middle is the modulus.

import {
  AmbientLight, BufferAttribute, Color, DirectionalLight, Mesh, MeshLambertMaterial, PerspectiveCamera, Scene, SphereGeometry, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { coloursOf } from "../colours";
import type { Structure } from "../data";
import { download, el, printed, quantity } from "../dom";
import { colour, onTheme } from "../theme";
import { averages, inverse, shearModulus, youngsModulus, type Matrix, type Vector } from "./tensor";

interface Surface {
  title: string;
  scene: Scene;
  note: string;
  /** Sets the colours for the present background. */
  paint: () => void;
}

export function stiffnessOf(structure: Structure): Matrix | null {
  const found = structure.results.find((result) => result.path === "/mechanics/linear/elastic_tensor");
  return found && Array.isArray(found.value) && found.value.every((row) => Array.isArray(row) && row.every((v) => typeof v === "number"))
    ? (found.value as Matrix) : null;
}

function surfaceMesh(value: (n: Vector) => number): { mesh: Mesh; least: number; most: number; paint: () => void } {
  const geometry = new SphereGeometry(1, 96, 64);
  const place = geometry.getAttribute("position");
  const values: number[] = [];
  for (let k = 0; k < place.count; ++k) {
    values.push(value([place.getX(k), place.getY(k), place.getZ(k)]));
  }
  const most = Math.max(...values);
  const least = Math.min(...values);
  values.forEach((modulus, k) => {
    const part = modulus / most;
    place.setXYZ(k, place.getX(k) * part, place.getY(k) * part, place.getZ(k) * part);
  });
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(3 * place.count), 3));
  geometry.computeVertexNormals();
  const paint = (): void => {
    const colours = geometry.getAttribute("color");
    const colourOf = coloursOf("viridis");
    values.forEach((modulus, k) => {
      const rgb = colourOf(most > least ? (modulus - least) / (most - least) : 1);
      new Color().setRGB(...(rgb.map((c) => c / 255) as Vector), "srgb").toArray(colours.array, 3 * k);
    });
    colours.needsUpdate = true;
  };
  return { mesh: new Mesh(geometry, new MeshLambertMaterial({ vertexColors: true })), least, most, paint };
}

function sceneOf(mesh: Mesh): Scene {
  const scene = new Scene();
  const light = new DirectionalLight(0xffffff, 2.2);
  light.position.set(-1, 2, 3);
  scene.add(mesh, light, new AmbientLight(0xffffff, 1.1));
  return scene;
}

function surfacesOf(structure: Structure, several: boolean): { surfaces: Surface[]; sentence: string } {
  const stiffness = stiffnessOf(structure);
  if (!stiffness) {
    return { surfaces: [], sentence: "" };
  }
  const before = several ? `${structure.name}: ` : "";
  const compliance = inverse(stiffness);
  const none = { surfaces: [], sentence: `${before}the network does not resist every strain, so there is no modulus for every direction.` };
  if (!compliance) {
    return none;
  }
  const young = surfaceMesh((n) => youngsModulus(compliance, n));
  const shear = surfaceMesh((n) => shearModulus(compliance, n).mean);
  if (!(young.least > 0 && shear.least > 0)) {
    return none;
  }
  const range = (one: { least: number; most: number }): string => `${quantity(one.least, "Pa")} to ${quantity(one.most, "Pa")}`;
  const mean = averages(stiffness, compliance);
  return {
    surfaces: [
      { title: `${before}Young's modulus`, scene: sceneOf(young.mesh), note: range(young), paint: young.paint },
      { title: `${before}shear modulus`, scene: sceneOf(shear.mesh), note: range(shear), paint: shear.paint },
    ],
    sentence: `${before}bulk modulus ${quantity(mean.bulk.reuss, "Pa")} to ${quantity(mean.bulk.voigt, "Pa")} and shear modulus ` +
      `${quantity(mean.shear.reuss, "Pa")} to ${quantity(mean.shear.voigt, "Pa")} (Reuss to Voigt); universal anisotropy ${printed(mean.anisotropy, 3)}.`,
  };
}

/** Directions on a grid with the moduli there. */
function surfaceCsv(structures: Structure[]): string {
  const rows = ["structure,nx,ny,nz,youngs_modulus [Pa],shear_modulus [Pa],shear_modulus_least [Pa],shear_modulus_most [Pa]"];
  for (const structure of structures) {
    const compliance = inverse(stiffnessOf(structure) ?? []);
    for (let theta = 0; compliance && theta <= 180; theta += 10) {
      for (let phi = 0; phi < 360; phi += 10) {
        const [t, p] = [(theta * Math.PI) / 180, (phi * Math.PI) / 180];
        const n: Vector = [Math.sin(t) * Math.cos(p), Math.sin(t) * Math.sin(p), Math.cos(t)];
        const shear = shearModulus(compliance, n);
        rows.push([`"${structure.name.replaceAll('"', '""')}"`, ...n, youngsModulus(compliance, n), shear.mean, shear.least, shear.most].join(","));
      }
    }
  }
  return rows.join("\n") + "\n";
}

/** The figure; null where no structure has an elastic tensor. */
export function elasticFigure(structures: Structure[]): HTMLElement | null {
  const all = structures.filter(stiffnessOf).map((structure) => surfacesOf(structure, structures.length > 1));
  if (all.length === 0) {
    return null;
  }
  const surfaces = all.flatMap((one) => one.surfaces);
  const host = el("div", { class: "surfaces", style: `--columns: ${Math.min(2, surfaces.length)}; --rows: ${Math.ceil(surfaces.length / 2)}` });
  const figure = el("figure", { class: "chart elastic", id: "moduli-in-every-direction" },
    el("div", { class: "head" }, el("h3", {}, "Moduli in every direction"), el("div", { class: "tools" },
      el("button", { type: "button", class: "quiet csv", "aria-label": "Numbers of this figure as CSV", onclick: () => download("moduli-in-every-direction.csv", surfaceCsv(structures)) }, "CSV"))),
    host,
    el("figcaption", {}, `The distance of the surface from the middle and its colour are the modulus. Shear modulus: of plates normal to the direction, mean of the directions of shear. ${all.map((one) => one.sentence).join(" ")}`));
  if (surfaces.length > 0) {
    try {
      drawSurfaces(host, surfaces);
    } catch {
      host.replaceChildren(el("p", { class: "missing" }, "This browser does not offer WebGL 2, without which the surfaces cannot be drawn. The CSV has the numbers."));
    }
  }
  return figure;
}

function drawSurfaces(host: HTMLElement, surfaces: Surface[]): void {
  const renderer = new WebGLRenderer({ antialias: true });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  const canvas = renderer.domElement;
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", surfaces.map((one) => `${one.title}, ${one.note}`).join("; "));
  host.append(canvas, ...surfaces.map((one, k) => el("p", { class: "label", style: `grid-area: ${Math.floor(k / 2) + 1} / ${(k % 2) + 1}` },
    el("b", {}, one.title), el("br"), one.note)));
  const camera = new PerspectiveCamera(30, 1, 0.1, 50);
  camera.position.set(2.8, 2.1, 3.9);
  const controls = new OrbitControls(camera, canvas);
  controls.enablePan = false;
  controls.enableZoom = false;
  const columns = Math.min(2, surfaces.length);
  const rows = Math.ceil(surfaces.length / 2);
  const draw = (): void => {
    const [width, height] = [canvas.clientWidth / columns, canvas.clientHeight / rows];
    if (width < 10 || height < 10) {
      return;
    }
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    renderer.setScissorTest(true);
    surfaces.forEach(({ scene }, k) => {
      const [x, y] = [(k % 2) * width, (rows - 1 - Math.floor(k / 2)) * height];
      renderer.setViewport(x, y, width, height);
      renderer.setScissor(x, y, width, height);
      renderer.render(scene, camera);
    });
  };
  const theme = (): void => {
    renderer.setClearColor(new Color(colour("--paper")));
    surfaces.forEach((one) => one.paint());
    draw();
  };
  controls.addEventListener("change", draw);
  new ResizeObserver(() => {
    renderer.setSize(host.clientWidth, host.clientHeight, true);
    draw();
  }).observe(host);
  onTheme(theme);
  theme();
}
