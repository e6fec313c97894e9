// SPDX-License-Identifier: Apache-2.0
import type { Bounds } from "../model/path.ts";

const most_px_per_m = 400;
const least_px_per_m = 0.02;
const margin_px = 64; // around what is shown whole
const least_m = 10; // across, however short the drive

/** Which part of the map is seen: its centre, m, and the scale. Up is +y. Sizes in CSS pixels. */
export class View {
  x = 0;
  y = 0;
  px_per_m = 12;
  width = 1;
  height = 1;

  toScreen(x: number, y: number): { x: number; y: number } {
    return { x: this.width / 2 + (x - this.x) * this.px_per_m, y: this.height / 2 - (y - this.y) * this.px_per_m };
  }

  toMap(px: number, py: number): { x: number; y: number } {
    return { x: this.x + (px - this.width / 2) / this.px_per_m, y: this.y - (py - this.height / 2) / this.px_per_m };
  }

  move(dx_px: number, dy_px: number): void {
    this.x -= dx_px / this.px_per_m;
    this.y += dy_px / this.px_per_m;
  }

  /** Scales by `factor`; what is at this pixel stays there. */
  zoom(factor: number, px = this.width / 2, py = this.height / 2): void {
    const fixed = this.toMap(px, py);
    this.px_per_m = Math.min(most_px_per_m, Math.max(least_px_per_m, this.px_per_m * factor));
    const moved = this.toMap(px, py);
    this.x += fixed.x - moved.x;
    this.y += fixed.y - moved.y;
  }

  /** Shows all of `bounds`, with a margin; `covered_px` at the left is covered by something else. */
  fit({ left, right, bottom, top }: Bounds, covered_px = 0): void {
    if (!(right >= left)) return;
    const across = Math.max(100, this.width - covered_px - 2 * margin_px) / Math.max(least_m, right - left);
    const up = Math.max(100, this.height - 2 * margin_px) / Math.max(least_m, top - bottom);
    this.px_per_m = Math.min(most_px_per_m, Math.max(least_px_per_m, Math.min(across, up)));
    this.x = (left + right - covered_px / this.px_per_m) / 2;
    this.y = (bottom + top) / 2;
  }

  /** The visible part of the map, with a margin in pixels. */
  seen(margin_px = 0): Bounds {
    const corner = this.toMap(-margin_px, this.height + margin_px);
    const opposite = this.toMap(this.width + margin_px, -margin_px);
    return { left: corner.x, right: opposite.x, bottom: corner.y, top: opposite.y };
  }
}
