// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of the page and numbers as people read them.

type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | undefined | ((event: never) => void)>;

/** An element with attributes ("class", "aria-label" ...), listeners ("onclick") and children. Texts go in as texts, never as HTML. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") {
      element.addEventListener(name.slice(2), value as EventListener);
    } else if (value === true) {
      element.setAttribute(name, "");
    } else if (value !== false && value !== undefined) {
      element.setAttribute(name, String(value));
    }
  }
  for (const child of children) {
    if (child) {
      element.append(child);
    }
  }
  return element;
}

/** A labelled control: the label stands before it. */
export function labelled(text: string, control: HTMLElement, title = ""): HTMLLabelElement {
  return el("label", { class: "control", title: title || undefined }, el("span", {}, text), control);
}

export function checkbox(text: string, checked: boolean, change: (on: boolean) => void, title = ""): HTMLLabelElement {
  const box = el("input", { type: "checkbox", checked, onchange: () => change(box.checked) });
  return el("label", { class: "control check", title: title || undefined }, box, el("span", {}, text));
}

export function slider(
  range: { min: number; max: number; step: number; value: number; name: string },
  change: (value: number) => void,
): HTMLInputElement {
  const input = el("input", {
    type: "range", min: range.min, max: range.max, step: range.step, value: range.value, "aria-label": range.name,
    oninput: () => change(Number(input.value)),
  });
  return input;
}

/** A field for a number; empty means what the placeholder says. */
export function numberInput(value: number | null, placeholder: string, name: string, change: (value: number | null) => void): HTMLInputElement {
  const input = el("input", { type: "text", inputmode: "decimal", class: "number", size: 8, value: value === null ? "" : String(value), placeholder, "aria-label": name,
    onchange: () => {
      const text = input.value.trim().replace(",", ".").replace("−", "-");
      const number = Number(text);
      if (text === "" || Number.isFinite(number)) {
        change(text === "" ? null : number);
      } else {
        input.value = "";
      }
    } });
  return input;
}

export function select(
  options: { value: string; label: string }[],
  value: string,
  name: string,
  change: (value: string) => void,
): HTMLSelectElement {
  const list = el("select", { "aria-label": name, onchange: () => change(list.value) },
    ...options.map((option) => el("option", { value: option.value, selected: option.value === value }, option.label)));
  return list;
}

const superscripts: Record<string, string> = {
  "-": "⁻", "0": "⁰", "1": "¹", "2": "²", "3": "³", "4": "⁴", "5": "⁵", "6": "⁶", "7": "⁷", "8": "⁸", "9": "⁹",
};

/** Digits as a power. */
export function raised(exponent: number): string {
  return [...String(exponent)].map((digit) => superscripts[digit] ?? digit).join("");
}

/** Four digits, without an exponent where that is readable. */
export function printed(value: number, digits = 4): string {
  if (!Number.isFinite(value)) {
    return "–";
  }
  if (value === 0) {
    return "0";
  }
  const exponent = Math.floor(Math.log10(Math.abs(value)) + 1e-12);
  if (Number.isInteger(value) && Math.abs(value) < 1e7) {
    return String(value).replace("-", "−");
  }
  if (exponent >= -3 && exponent < 6) {
    return value.toPrecision(Math.max(digits, exponent + 1)).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "").replace("-", "−");
  }
  const factor = (value / 10 ** exponent).toPrecision(digits).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "").replace("-", "−");
  return `${factor} × 10${raised(exponent)}`;
}

const prefixes = ["p", "n", "µ", "m", "", "k", "M", "G"];
const prefixed = new Set(["m", "Pa", "N", "N/m", "s", "Hz", "J"]);

/** UDUNITS text as one would print it. */
export function printedUnit(unit: string): string {
  return unit === "1" ? "" : unit.replace(/\^?(-?\d+)/g, (_, digits: string) => [...digits].map((d) => superscripts[d] ?? d).join(""))
    .replace(/\./g, " ");
}

/** The power of 1000 whose prefix brings a value of this unit between 1 and 1000. */
export function prefixOf(value: number, unit: string): { factor: number; unit: string } {
  if (!prefixed.has(unit) || value === 0 || !Number.isFinite(value)) {
    return { factor: 1, unit: printedUnit(unit) };
  }
  const power = Math.min(Math.max(Math.floor(Math.log10(Math.abs(value)) / 3 + 1e-9), -4), 3);
  return { factor: 1000 ** power, unit: (prefixes[power + 4] ?? "") + printedUnit(unit) };
}

/** The unit in which a list up to `largest` is easy to read: lengths, their powers and pressures with a prefix, angles in degrees. */
export function shownUnit(largest: number, unit: string): { factor: number; unit: string } {
  if (unit === "rad") {
    return { factor: Math.PI / 180, unit: "°" };
  }
  if (unit === "rad-1") {
    return { factor: 180 / Math.PI, unit: "1/°" };
  }
  const inverse = /^m-([1-9])$/.exec(unit);
  if (inverse && largest > 0) {
    const n = Number(inverse[1]);
    const power = Math.min(Math.max(Math.floor(Math.log10(largest) / (3 * n) + 1e-9), -1), 4);
    return { factor: 1000 ** (power * n), unit: (prefixes[4 - power] ?? "") + printedUnit(unit) };
  }
  return prefixOf(largest, unit);
}

/** "1.36 ± 0.05 MPa": the error with two digits, the value as far as the error goes. */
export function quantityWithError(value: number, error: number | null, unit: string): string {
  if (error === null || !(error > 0) || !Number.isFinite(value)) {
    return quantity(value, unit);
  }
  const prefix = prefixOf(Math.max(Math.abs(value), error), unit);
  const decimals = Math.min(Math.max(1 - Math.floor(Math.log10(error / prefix.factor)), 0), 8);
  const text = (number: number): string => (number / prefix.factor).toFixed(decimals).replace("-", "−");
  return `${text(value)} ± ${text(error)}${prefix.unit ? `\u00a0${prefix.unit}` : ""}`;
}

/** "1.357 MPa" */
export function quantity(value: number | null, unit: string, digits = 4): string {
  if (value === null || !Number.isFinite(value)) {
    return "–";
  }
  const prefix = prefixOf(value, unit);
  return printed(value / prefix.factor, digits) + (prefix.unit ? `\u00a0${prefix.unit}` : "");
}

/** A text as a field of a CSV file. */
export function csvField(text: string): string {
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** Offers a file for download. */
export function download(name: string, text: string): void {
  const address = URL.createObjectURL(new Blob([text], { type: "text/csv;charset=utf-8" }));
  const link = el("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}
