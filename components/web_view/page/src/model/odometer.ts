// SPDX-License-Identifier: Apache-2.0
import { distance, type Pose2 } from "./geometry.ts";
import type { Path } from "./path.ts";

const step_m = 0.1; // shorter movements are noise at standstill

/** Length of the way driven. */
export class Odometer {
  length_m = 0;
  #last: Pose2 | undefined;

  static of(path: Path): Odometer {
    const odometer = new Odometer();
    for (let i = 0; i < path.count; ++i) odometer.add(path.at(i));
    return odometer;
  }

  add(pose: Pose2): void {
    const step = this.#last ? distance(this.#last, pose) : 0;
    if (this.#last && step < step_m) return;
    this.length_m += step;
    this.#last = pose;
  }
}
