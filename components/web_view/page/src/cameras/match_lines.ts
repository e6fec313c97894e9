// SPDX-License-Identifier: Apache-2.0
/** Lines between the panorama and the picture of the recognised place, both turned to one heading: what was seen again, and where. */
import type { MatchedPoint } from "../model/matches.ts";
import { h, setText } from "../ui/dom.ts";

/** Where a picture lies, in px: the part of it that is seen, and its whole. */
export interface Shown {
  left: number;
  top: number;
  bottom: number;
  width: number;
  pictureTop: number;
  pictureHeight: number;
}

export interface Line {
  x1: number;
  y1: number;
  x2: number;
  y2: number;
  agrees: boolean;
}

const position = 0.55; // of a picture that is higher than its frame, as in the style sheet

/** A picture that fills the width of its frame, whose box is given; `aspect`: width by height of the picture. */
export function shownIn(box: { left: number; top: number; width: number; height: number }, aspect: number): Shown {
  const pictureHeight = box.width / aspect;
  const pictureTop = box.top + (box.height - pictureHeight) * position;
  return { left: box.left, top: box.top, bottom: box.top + box.height, width: box.width, pictureTop, pictureHeight };
}

const inside = (y: number, { top, bottom }: Shown) => y >= top && y <= bottom;

/** Of the points that are seen in both. `shift`: see shiftOf. Those that agree come last, on top. */
export function linesBetween(points: MatchedPoint[], panorama: Shown, place: Shown, shift: number): Line[] {
  const lines = points.map(({ u, v, placeU, placeV, agrees }) => ({
    x1: panorama.left + u * panorama.width,
    y1: panorama.pictureTop + v * panorama.pictureHeight,
    x2: place.left + ((placeU + shift) % 1) * place.width,
    y2: place.pictureTop + placeV * place.pictureHeight,
    agrees,
  }));
  return lines.filter(({ y1, y2 }) => inside(y1, panorama) && inside(y2, place)).sort((a, b) => Number(a.agrees) - Number(b.agrees));
}

const styles = [
  { agrees: false, colour: "#ff9148", dash: [3, 3] },
  { agrees: true, colour: "#35c99b", dash: [] },
];
const dot_px = 2;

function draw(context: CanvasRenderingContext2D, lines: Line[]): void {
  for (const { agrees, colour, dash } of styles) {
    const ofKind = lines.filter((line) => line.agrees === agrees);
    context.strokeStyle = context.fillStyle = colour;
    context.setLineDash(dash);
    context.beginPath();
    for (const { x1, y1, x2, y2 } of ofKind) {
      context.moveTo(x1, y1);
      context.lineTo(x2, y2);
    }
    context.stroke();
    for (const { x1, y1, x2, y2 } of ofKind) {
      context.fillRect(x1 - dot_px, y1 - dot_px, 2 * dot_px, 2 * dot_px);
      context.fillRect(x2 - dot_px, y2 - dot_px, 2 * dot_px, 2 * dot_px);
    }
  }
}

/** A canvas over both pictures, the numbers in words, and the button that hides the lines. */
export class MatchLines {
  readonly canvas = h("canvas.lines", { "aria-hidden": "true" });
  readonly legend = h("p.legend", { hidden: true });
  readonly button = h("button.small", { "aria-pressed": "true", hidden: true }, "Lines");
  #agree = h("b");
  #contradict = h("b");
  #isOn = true;
  #key = "";

  constructor() {
    this.legend.append(h("span.inlier", {}, this.#agree, " points agree with the pose"), h("span.outlier", {}, this.#contradict, " contradict it"));
    this.button.onclick = () => {
      this.#isOn = !this.#isOn;
      this.button.setAttribute("aria-pressed", String(this.#isOn));
    };
  }

  /** Undefined: there are none to be shown. `boxes`: of the canvas's parent and of both pictures, on the screen. */
  show(points: MatchedPoint[] | undefined, key: string, lines: (origin: { left: number; top: number }) => Line[]): void {
    this.button.hidden = this.legend.hidden = !points;
    const area = this.canvas.parentElement!.getBoundingClientRect();
    const now = points && this.#isOn ? `${key} ${area.width} ${area.height} ${devicePixelRatio}` : "";
    if (points) {
      const agreeing = points.filter(({ agrees }) => agrees).length;
      setText(this.#agree, String(agreeing));
      setText(this.#contradict, String(points.length - agreeing));
    }
    if (now === this.#key) return;
    this.#key = now;
    const { canvas } = this;
    canvas.width = Math.max(1, Math.round(area.width * devicePixelRatio)); // also clears it
    canvas.height = Math.max(1, Math.round(area.height * devicePixelRatio));
    if (now === "") return;
    const context = canvas.getContext("2d")!;
    context.scale(devicePixelRatio, devicePixelRatio);
    draw(context, lines(area));
  }
}
