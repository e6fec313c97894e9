// SPDX-License-Identifier: Apache-2.0
import type { Pen } from "./trace.ts";

/** What is used of a canvas. */
export interface Stroker extends Pen {
  beginPath(): void;
  stroke(): void;
}

/**
 * Strokes a long line in pieces: the time of one stroke grows faster than the number of its points. The pieces meet in a point, so that
 * with round ends nothing is seen of it.
 */
export class Pieces implements Pen {
  #points = 0;

  constructor(
    readonly canvas: Stroker,
    readonly most = 100,
  ) {
    canvas.beginPath();
  }

  moveTo(x: number, y: number): void {
    this.canvas.moveTo(x, y);
  }

  lineTo(x: number, y: number): void {
    this.canvas.lineTo(x, y);
    if (++this.#points < this.most) return;
    this.end();
    this.canvas.beginPath();
    this.canvas.moveTo(x, y);
    this.#points = 0;
  }

  end(): void {
    this.canvas.stroke();
  }
}
