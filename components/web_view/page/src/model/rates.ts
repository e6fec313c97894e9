// SPDX-License-Identifier: Apache-2.0

/** Messages per second, of a topic, by their stamps, over the last `window_s`. */
export class Rate {
  #stamps: number[] = [];

  constructor(readonly window_s = 2) {}

  /** Returns the rate in Hz; undefined until there are two stamps. */
  add(stamp: number): number | undefined {
    this.#stamps.push(stamp);
    while (this.#stamps[0]! < stamp - this.window_s) this.#stamps.shift();
    const span = stamp - this.#stamps[0]!;
    return span > 0 ? (this.#stamps.length - 1) / span : undefined;
  }
}
