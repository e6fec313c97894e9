// SPDX-License-Identifier: Apache-2.0
import type { Colours } from "../ui/colours.ts";
import { lengthText, roundLength } from "./scale.ts";
import type { View } from "./view.ts";

const least_px = 55; // between the lines

function lines(context: CanvasRenderingContext2D, view: View, step: number): void {
  const seen = view.seen();
  context.beginPath();
  for (let x = Math.ceil(seen.left / step) * step; x <= seen.right; x += step) {
    const px = Math.round(view.toScreen(x, 0).x) + 0.5;
    context.moveTo(px, 0);
    context.lineTo(px, view.height);
  }
  for (let y = Math.ceil(seen.bottom / step) * step; y <= seen.top; y += step) {
    const py = Math.round(view.toScreen(0, y).y) + 0.5;
    context.moveTo(0, py);
    context.lineTo(view.width, py);
  }
  context.stroke();
}

/** A grid of round lengths in two weights. */
export function drawGrid(context: CanvasRenderingContext2D, view: View, colours: Colours): void {
  const step = roundLength((2.5 * least_px) / view.px_per_m);
  context.lineWidth = 1;
  context.strokeStyle = colours.grid;
  lines(context, view, step);
  context.strokeStyle = colours["grid-strong"];
  lines(context, view, step * 5);
}

/** At the lower left, `bottom_px` above the edge. */
export function drawScaleBar(context: CanvasRenderingContext2D, view: View, colours: Colours): void {
  const metres = roundLength(140 / view.px_per_m);
  const width = metres * view.px_per_m;
  const x = 16.5;
  const y = view.height - 16.5;
  context.strokeStyle = colours.card;
  for (const [line, colour] of [[4.5, colours.card], [1.5, colours.ink]] as const) {
    context.lineWidth = line;
    context.strokeStyle = colour;
    context.beginPath();
    context.moveTo(x, y - 5);
    context.lineTo(x, y);
    context.lineTo(x + width, y);
    context.lineTo(x + width, y - 5);
    context.stroke();
  }
  haloText(context, lengthText(metres), x + width / 2, y - 6, colours, "center");
}

/** Where a tool acts that is used by keys. */
export function drawMiddle(context: CanvasRenderingContext2D, view: View, colours: Colours): void {
  const [x, y] = [Math.round(view.width / 2) + 0.5, Math.round(view.height / 2) + 0.5];
  for (const [line, colour] of [[4, colours.card], [1.5, colours.ink]] as const) {
    context.lineWidth = line;
    context.strokeStyle = colour;
    context.beginPath();
    context.moveTo(x - 12, y);
    context.lineTo(x + 12, y);
    context.moveTo(x, y - 12);
    context.lineTo(x, y + 12);
    context.stroke();
  }
}

/** Text that can be read on any ground. */
export function haloText(context: CanvasRenderingContext2D, text: string, x: number, y: number, colours: Colours, align: CanvasTextAlign, colour = colours.ink): void {
  context.font = "500 12px system-ui, 'DejaVu Sans', sans-serif";
  context.textAlign = align;
  context.lineWidth = 4;
  context.lineJoin = "round";
  context.strokeStyle = colours.card;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}
