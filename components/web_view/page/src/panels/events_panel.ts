// SPDX-License-Identifier: Apache-2.0
/** What happened, the newest first. A tap shows it on the map. */
import type { Drive } from "../model/drive.ts";
import type { Entry } from "../model/happenings.ts";
import { clock, h } from "../ui/dom.ts";
import { glyph } from "../ui/glyph.ts";

export class EventsPanel {
  #list = h("ol.events");
  #empty = h("p.empty", {}, "Nothing has happened yet. Recognised places and changes of the state will be listed here.");
  #shown: Entry[] = [];

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
    if (entries === this.#shown && this.#list.childElementCount === entries.length) return;
    // Another drive, or old entries were left out: from scratch.
    if (entries !== this.#shown || this.#list.childElementCount > entries.length || entries.length === 500) this.#list.replaceChildren();
    this.#shown = entries;
    for (const entry of entries.slice(this.#list.childElementCount)) this.#list.prepend(this.#line(entry, begin));
  }

  #line(entry: Entry, begin: number): HTMLElement {
    const text = h("span", {}, h("b", {}, entry.text), entry.detail ? h("small", {}, entry.detail) : undefined);
    const button = h("button", { onclick: () => this.onChoice(entry) }, glyph(entry.level), text, h("time", {}, clock(entry.time - begin)));
    return h("li", {}, button);
  }
}
