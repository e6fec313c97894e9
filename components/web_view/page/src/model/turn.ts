// SPDX-License-Identifier: Apache-2.0
import { wrapped } from "./geometry.ts";
import { seconds, type AzimuthChange } from "./messages.ts";
import type { Path } from "./path.ts";

export interface Turn {
  time: number;
  compass: number; // degrees per second, left positive
  odometry: number;
}

const gap_s = 0.5; // longest one between poses of the odometry

/** Compares the turn between two panoramas with that of the odometry, whose images may have other stamps. */
export class TurnComparison {
  #waiting: AzimuthChange[] = [];

  add(change: AzimuthChange): void {
    if (change.valid) this.#waiting.push(change);
    if (this.#waiting.length > 50) this.#waiting.shift(); // no odometry comes
  }

  clear(): void {
    this.#waiting = [];
  }

  /** Comparisons whose odometry has arrived. */
  take(odometry: Path): Turn[] {
    const turns: Turn[] = [];
    const last = odometry.count > 0 ? odometry.times[odometry.count - 1]! : -Infinity;
    while (this.#waiting.length > 0 && seconds(this.#waiting[0]!.header.stamp) <= last + 1e-3) {
      const change = this.#waiting.shift()!;
      const to = seconds(change.header.stamp);
      const from = seconds(change.from_stamp);
      const before = odometry.between(from, gap_s);
      const after = odometry.between(to, gap_s);
      if (!before || !after || to <= from) continue;
      const perSecond = 180 / Math.PI / (to - from);
      turns.push({ time: to, compass: change.azimuth_change_rad * perSecond, odometry: wrapped(after.yaw - before.yaw) * perSecond });
    }
    return turns;
  }
}
