// SPDX-License-Identifier: Apache-2.0
/** The head of the page: the state in one line, and the figures of the moment. */
import type { Head } from "../model/head.ts";
import { metres, stateLine, type Known } from "../model/state_line.ts";
import { byId, clock, h, setText } from "../ui/dom.ts";
import { setGlyph } from "../ui/glyph.ts";

type Figure = [label: string, text: (head: Head) => string | undefined];

const figures: Figure[] = [
  ["Position", ({ ellipse }) => (ellipse ? `±${metres(ellipse.major)}` : undefined)],
  ["Protection level", ({ integrity }) => integrity && metres(integrity.horizontal_protection_level_m)],
  ["Drift removed", ({ drift_m }) => (Number.isFinite(drift_m) ? metres(drift_m) : undefined)],
  ["True error", ({ error_m }) => (Number.isFinite(error_m) ? metres(error_m) : undefined)],
  ["Speed", ({ speed }) => (Number.isFinite(speed) ? `${speed.toFixed(1)} m/s` : undefined)],
  ["Driven", ({ driven_m }) => (driven_m > 0 ? metres(driven_m) : undefined)],
  ["Time", ({ now, begin }) => (Number.isFinite(now) ? clock(now - begin) : undefined)],
];

export class StatePanel {
  #figures = figures.map(([label, text]) => ({ text, value: h("dd"), element: h("div", { hidden: true }, h("dt", {}, label)) }));

  constructor() {
    for (const { element, value } of this.#figures) element.append(value);
    byId("figures").append(...this.#figures.map(({ element }) => element));
  }

  update(head: Head, reception: Pick<Known, "silent_s" | "link" | "isPaused">): void {
    const { level, title, reason } = stateLine({ state: head.state, integrity: head.integrity, quality: head.quality, ...reception });
    byId("state").dataset.level = level;
    setGlyph(byId("state-glyph"), level);
    setText(byId("state-title"), title);
    setText(byId("state-reason"), reason);
    document.title = `${title} – panvo`;
    for (const { element, value, text } of this.#figures) {
      const shown = text(head);
      element.hidden = shown === undefined;
      if (shown !== undefined) setText(value, shown);
    }
  }
}
