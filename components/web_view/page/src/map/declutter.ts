// SPDX-License-Identifier: Apache-2.0

/** Of points that would cover each other only the first is drawn. Sizes in pixels. */
export class Declutter {
  #taken = new Set<number>();

  constructor(readonly cell_px: number) {}

  takes(x: number, y: number): boolean {
    const key = Math.round(x / this.cell_px) * 65_536 + Math.round(y / this.cell_px);
    if (this.#taken.has(key)) return false;
    this.#taken.add(key);
    return true;
  }
}
