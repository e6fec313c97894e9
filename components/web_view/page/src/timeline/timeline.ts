// SPDX-License-Identifier: Apache-2.0
/** The charts under the map: the last minutes, or the whole drive, with one cursor for all. */
import type { Drive } from "../model/drive.ts";
import { onSchemeChange, readColours } from "../ui/colours.ts";
import { clock, h, setText } from "../ui/dom.ts";
import { charts } from "./charts.ts";
import { Plot } from "./plot.ts";
import { drawStrip } from "./state_strip.ts";

const windows: [string, number][] = [
  ["1 min", 60],
  ["5 min", 300],
  ["All", Infinity],
];

export class Timeline {
  cursor_s: number | undefined;
  window_s = 60;
  staysAt = false; // the cursor stays where it was last
  #colours = readColours();
  #strip = h("canvas.strip", { "aria-label": "State over time" });
  #time = h("span.cursor");
  #buttons: HTMLButtonElement[];
  #plots: Plot[];

  constructor(
    readonly element: HTMLElement,
    readonly drive: Drive,
    readonly onCursor: (time: number | undefined) => void,
  ) {
    this.#plots = charts.map(
      (chart) =>
        new Plot(chart, (time) => {
          if (time !== undefined || !this.staysAt) this.#setCursor(time);
        }),
    );
    this.#buttons = windows.map(([text, seconds]) =>
      h("button", { onclick: () => this.choose(seconds), "aria-pressed": String(seconds === this.window_s) }, text),
    );
    element.append(
      h("div.bar", {}, h("h2", {}, "Time line"), this.#time, h("div", { id: "player", hidden: true }), h("div.segments", {}, ...this.#buttons)),
      this.#strip,
      h("div.charts", {}, ...this.#plots.map((plot) => plot.element)),
    );
    onSchemeChange(() => {
      this.#colours = readColours();
      this.update();
    });
  }

  update(): void {
    const { drive } = this;
    if (this.element.clientHeight === 0 || !Number.isFinite(drive.now)) return;
    const from = Math.max(drive.begin, drive.now - this.window_s);
    drawStrip(this.#strip, drive, this.#colours, from, drive.now);
    for (const plot of this.#plots) plot.update(drive, this.#colours, from, drive.now, this.cursor_s);
    this.#tellTime();
  }

  /** Moves the cursor by some seconds of the drive. */
  step(seconds: number): void {
    this.moveTo((this.cursor_s ?? this.drive.now) + seconds);
  }

  moveTo(time: number): void {
    const { begin, now } = this.drive;
    this.#setCursor(Math.min(Math.max(time, begin), now));
  }

  choose(window_s: number): void {
    this.window_s = window_s;
    this.#buttons.forEach((button, i) => button.setAttribute("aria-pressed", String(windows[i]![1] === window_s)));
    this.update();
  }

  #setCursor(time: number | undefined): void {
    if (time === this.cursor_s || Math.abs(time! - this.cursor_s!) < 1e-3) return; // a plot has only rounded it
    this.cursor_s = time;
    for (const plot of this.#plots) plot.tell(time);
    this.#tellTime();
    this.onCursor(time);
  }

  #tellTime(): void {
    setText(this.#time, clock((this.cursor_s ?? this.drive.now) - this.drive.begin));
    this.#time.classList.toggle("past", this.cursor_s !== undefined);
  }
}
