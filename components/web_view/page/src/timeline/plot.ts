// SPDX-License-Identifier: Apache-2.0
/** One chart: title, values in words, curves. */
import uPlot from "uplot";
import type { Drive } from "../model/drive.ts";
import { thinned } from "../model/series.ts";
import type { Colours } from "../ui/colours.ts";
import { clock, h, setText } from "../ui/dom.ts";
import type { Chart, Curve } from "./charts.ts";
import { nearestValue } from "./values.ts";

const points_per_px = 1;

export class Plot {
  readonly element: HTMLElement;
  #values: HTMLElement;
  #canvas: HTMLElement;
  #plot: uPlot | undefined;
  #shown = ""; // the curves and colours that the plot was made for
  #curves: Curve[] = [];
  #isUpdating = false; // the plot then reports a cursor that the user has not moved

  constructor(
    readonly chart: Chart,
    readonly onCursor: (time: number | undefined) => void,
  ) {
    this.#values = h("p.values");
    this.#canvas = h("div.canvas");
    this.element = h("figure.chart", { hidden: true }, h("figcaption", {}, h("b", {}, chart.title), this.#values), this.#canvas);
  }

  /** Shows [from, to] of the drive's stamps; `cursor` is where the values are read, else at the end. */
  update(drive: Drive, colours: Colours, from: number, to: number, cursor: number | undefined): void {
    this.#curves = this.chart.curves(drive);
    this.element.hidden = this.#curves.length === 0;
    if (this.element.hidden || this.#canvas.clientWidth === 0) return;
    const key = JSON.stringify([this.#curves.map(({ label }) => label), colours]);
    if (key !== this.#shown) this.#make(drive, colours);
    this.#shown = key;
    const plot = this.#plot!;
    const size = { width: this.#canvas.clientWidth, height: this.#canvas.clientHeight };
    if (size.width !== plot.width || size.height !== plot.height) plot.setSize(size);
    const tables = this.#curves.map(({ series }) => {
      const { times, values } = thinned(series, from, to, size.width * points_per_px);
      return [times, values] as uPlot.AlignedData;
    });
    this.#isUpdating = true;
    plot.setData(tables.length === 1 ? tables[0]! : uPlot.join(tables, tables.map(() => [2])), false);
    plot.batch(() => {
      plot.setScale("x", { min: from, max: Math.max(to, from + 1) });
      plot.setScale("y", this.#range(tables));
    });
    this.#isUpdating = false;
    this.tell(cursor);
  }

  /** The values at a time, in words, and the line at it. */
  tell(cursor: number | undefined): void {
    const left = cursor === undefined ? -10 : (this.#plot?.valToPos(cursor, "x") ?? -10);
    if (left !== this.#plot?.cursor.left) this.#plot?.setCursor({ left, top: left < 0 ? -10 : 0 }, false);
    const parts = this.#curves.map(({ label, series }) => {
      const value = cursor === undefined ? series.last : nearestValue(series, cursor);
      return { label, text: value === null ? "–" : this.chart.format(value) };
    });
    if (this.#values.children.length !== parts.length)
      this.#values.replaceChildren(...this.#curves.map(() => h("span", {}, h("i"), h("span"), h("b"))));
    parts.forEach(({ label, text }, i) => {
      const [swatch, name, number] = this.#values.children[i]!.children as unknown as HTMLElement[];
      const { colour, dash } = this.#curves[i]!;
      swatch!.style.background = dash ? `repeating-linear-gradient(90deg, var(--${colour}) 0 3px, transparent 3px 6px)` : `var(--${colour})`;
      setText(name!, label);
      setText(number!, text);
    });
  }

  #range(tables: uPlot.AlignedData[]): { min: number; max: number } {
    let min = 0;
    let max = 0;
    for (const table of tables) {
      for (const value of table[1]!) {
        min = Math.min(min, value ?? 0);
        max = Math.max(max, value ?? 0);
      }
    }
    const margin = (max - min || 1) * 0.08;
    return { min: min < 0 ? min - margin : 0, max: max + margin };
  }

  #make(drive: Drive, colours: Colours): void {
    this.#plot?.destroy();
    const axis = { stroke: colours.soft, font: "11px system-ui, 'DejaVu Sans', sans-serif", ticks: { show: false } };
    const grid = { stroke: colours.grid, width: 1 };
    this.#plot = new uPlot(
      {
        width: Math.max(10, this.#canvas.clientWidth),
        height: Math.max(10, this.#canvas.clientHeight),
        padding: [6, 4, 0, 0],
        legend: { show: false },
        cursor: { sync: { key: "drive" }, drag: { x: false, y: false }, points: { size: 6 }, y: false },
        scales: { x: { time: false, auto: false }, y: { auto: false } },
        axes: [
          { ...axis, size: 22, gap: 6, space: 60, grid: { show: false }, values: (_, ticks) => ticks.map((tick) => clock(tick - drive.begin)) },
          { ...axis, size: 38, gap: 4, space: 26, grid },
        ],
        series: [
          {},
          ...this.#curves.map(({ colour, dash }) => ({
            stroke: colours[colour],
            width: 1.5,
            spanGaps: true,
            points: { show: false },
            ...(dash && { dash }),
          })),
        ],
        hooks: {
          setCursor: [
            (plot) => {
              if (this.#isUpdating) return;
              const { left } = plot.cursor;
              this.onCursor(left === undefined || left < 0 ? undefined : plot.posToVal(left, "x"));
            },
          ],
        },
      },
      [[], ...this.#curves.map(() => [])],
      this.#canvas,
    );
    listenToFingers(this.#plot);
  }
}

/** uPlot knows only the mouse: a finger moves the cursor sideways, and the page up and down. */
function listenToFingers(plot: uPlot): void {
  const { over } = plot;
  over.style.touchAction = "pan-y";
  const listen = (name: "pointerdown" | "pointermove" | "pointerup" | "pointercancel", left: (event: PointerEvent) => number) =>
    over.addEventListener(name, (event) => event.pointerType === "touch" && plot.setCursor({ left: left(event), top: 0 }));
  const at = ({ clientX }: PointerEvent) => Math.min(Math.max(0, clientX - over.getBoundingClientRect().left), over.clientWidth);
  listen("pointerdown", at);
  listen("pointermove", at);
  listen("pointerup", () => -10);
  listen("pointercancel", () => -10);
}
