// SPDX-License-Identifier: Apache-2.0
/** Marks of the levels: of different shape, so that they can be told apart without colours. */
import type { Level } from "../model/state_line.ts";

const shapes: Record<Level, string> = {
  good: '<circle cx="12" cy="12" r="10"/><path class="in" d="m7.3 12.4 3.2 3.2 6.2-6.6"/>',
  caution: '<path d="M12 2.2 23 21.5H1Z"/><path class="in" d="M12 9v6M12 18v.3"/>',
  bad: '<path d="M7.6 1.5h8.8l6.1 6.1v8.8l-6.1 6.1H7.6l-6.1-6.1V7.6Z"/><path class="in" d="m8 8 8 8M16 8l-8 8"/>',
  idle: '<circle class="ring" cx="12" cy="12" r="8.5"/>',
};

export function setGlyph(element: HTMLElement, level: Level): void {
  if (element.dataset.level === level) return;
  element.dataset.level = level;
  element.innerHTML = `<svg viewBox="0 0 24 24" aria-hidden="true">${shapes[level]}</svg>`;
}

export function glyph(level: Level): HTMLElement {
  const element = document.createElement("span");
  element.className = "glyph";
  setGlyph(element, level);
  return element;
}
