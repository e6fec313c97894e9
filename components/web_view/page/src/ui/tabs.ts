// SPDX-License-Identifier: Apache-2.0
/** Which panel is seen: on a phone one of all, on a larger screen one beside the map. */

const wide = matchMedia("(min-width: 900px)");
const beside = ["cameras", "events", "system"];

export class Tabs {
  #chosen = wide.matches ? "cameras" : "map";

  constructor(readonly onChange: () => void) {
    for (const button of this.#buttons()) button.addEventListener("click", () => this.choose(button.dataset.tab!));
    wide.addEventListener("change", () => this.choose(this.#chosen));
    this.choose(this.#chosen);
  }

  choose(name: string): void {
    this.#chosen = wide.matches && !beside.includes(name) ? "cameras" : name;
    document.body.dataset.tab = this.#chosen;
    for (const button of this.#buttons()) button.setAttribute("aria-pressed", String(button.dataset.tab === this.#chosen));
    this.onChange();
  }

  isSeen(name: string): boolean {
    return this.#chosen === name || (wide.matches && !beside.includes(name));
  }

  #buttons(): HTMLElement[] {
    return [...document.querySelectorAll<HTMLElement>("button[data-tab]")];
  }
}
