// SPDX-License-Identifier: Apache-2.0
/** Colours of the style sheet, for what is drawn on a canvas. */

const names = [
  "page", "card", "ink", "soft", "line", "grid", "grid-strong", "truth", "binocular", "enhanced", "compass", "landmark", "good", "caution", "bad", "idle",
] as const;

export type Colours = Record<(typeof names)[number], string>;

export function readColours(): Colours {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()])) as Colours;
}

/** Calls when the system changes between dark and light. */
export function onSchemeChange(call: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", call);
}
