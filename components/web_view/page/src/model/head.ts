// SPDX-License-Identifier: Apache-2.0
/** What the head of the page tells of a drive, now or at an earlier time. */
import type { Drive } from "./drive.ts";

export type Head = Pick<Drive, "state" | "integrity" | "quality" | "ellipse" | "drift_m" | "error_m" | "speed" | "driven_m" | "now" | "begin">;

/** Of the moment: it stays as it is while the drive goes on. */
export const headOf = ({ state, integrity, quality, ellipse, drift_m, error_m, speed, driven_m, now, begin }: Head): Head => ({
  state, integrity, quality, ellipse, drift_m, error_m, speed, driven_m, now, begin,
});

/** Heads in the order of their times. */
export class Heads {
  #all: { time: number; head: Head }[] = [];

  add(time: number, head: Head): void {
    this.#all.push({ time, head });
  }

  /** That of `time`; undefined: the last one. */
  at(time = Infinity): Head | undefined {
    return (this.#all.filter((one) => one.time <= time).at(-1) ?? this.#all[0])?.head;
  }
}
