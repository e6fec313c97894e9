// SPDX-License-Identifier: Apache-2.0
/** What happened, the newest first. A tap shows it on the map. */
import type { Drive } from "../model/drive.ts";
import type { Entry } from "../model/happenings.ts";
import { clock, h } from "../ui/dom.ts";
import { glyph } from "../ui/glyph.ts";

export class EventsPanel {
  #list = h("ol.events");
  #empty = h("p.empty", {}, "Nothing has happened yet. Recognised places and changes of the state will be listed here.");
  #shown: Entry | undefined; // the newest that is listed

  constructor(
    readonly element: HTMLElement,
    readonly drive: Drive,
    readonly onChoice: (entry: Entry) => void,
  ) {
    element.append(this.#empty, this.#list);
  }

  update(): void {
    const { entries, begin } = this.drive;
    this.#empty.hidden = entries.length > 0;
    if (entries.at(-1) === this.#shown) return;
    this.#shown = entries.at(-1);
    this.#list.replaceChildren(...entries.map((entry) => this.#line(entry, begin)).reverse());
  }

  #line(entry: Entry, begin: number): HTMLElement {
    const text = h("span", {}, h("b", {}, entry.text), entry.detail ? h("small", {}, entry.detail) : undefined);
    const button = h("button", { onclick: () => this.onChoice(entry) }, glyph(entry.level), text, h("time", {}, clock(entry.time - begin)));
    return h("li", {}, button);
  }
}
