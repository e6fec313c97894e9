// SPDX-License-Identifier: Apache-2.0
/** Waiting times between attempts to connect: doubled after each failure, up to a limit. */
export class BackOff {
  #failures = 0;

  constructor(
    readonly first_ms = 500,
    readonly longest_ms = 10_000,
  ) {}

  next_ms(): number {
    return Math.min(this.longest_ms, this.first_ms * 2 ** this.#failures++);
  }

  reset(): void {
    this.#failures = 0;
  }
}
