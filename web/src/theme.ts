// SPDX-License-Identifier: GPL-3.0-or-later
// Light and dark: what the system prefers, until the reader chooses.

import { el } from "./dom";

type Listener = () => void;
const listeners: Listener[] = [];
const query = window.matchMedia("(prefers-color-scheme: dark)");

export function isDark(): boolean {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === "dark" : query.matches;
}

/** A colour of the style sheet, such as "--ink". */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function onTheme(listener: Listener): void {
  listeners.push(listener);
}

function announce(): void {
  for (const listener of listeners) {
    listener();
  }
}

query.addEventListener("change", announce);
// A page is printed light.
window.addEventListener("beforeprint", () => { document.documentElement.dataset.printing = ""; announce(); });
window.addEventListener("afterprint", () => { delete document.documentElement.dataset.printing; announce(); });

export function themeButton(): HTMLButtonElement {
  const button = el("button", { type: "button", id: "theme", onclick: toggle });
  function show(): void {
    button.textContent = isDark() ? "Light" : "Dark";
    button.setAttribute("aria-label", isDark() ? "Light colours" : "Dark colours");
  }
  function toggle(): void {
    document.documentElement.dataset.theme = isDark() ? "light" : "dark";
    announce();
  }
  onTheme(show);
  show();
  return button;
}
