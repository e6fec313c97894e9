// SPDX-License-Identifier: Apache-2.0
import { composed, inverse, type Pose2 } from "./geometry.ts";
import type { Path } from "./path.ts";

const tries = 200; // poses of the reference that are compared

/**
 * Where a path that is given in another frame lies in the map: so that it meets the reference at the first stamp, from `from` on,
 * that both have. Stays as it is afterwards, so that the drift of one against the other is seen. Undefined: no common stamp yet.
 */
export function mapFromFrame(reference: Path, other: Path, from: number): Pose2 | undefined {
  const first = reference.indexAt(from - 1e-3) + 1;
  for (let i = first; i < Math.min(reference.count, first + tries); ++i) {
    const pose = other.exactly(reference.times[i]!);
    if (pose) return composed(reference.at(i), inverse(pose));
  }
  return undefined;
}
