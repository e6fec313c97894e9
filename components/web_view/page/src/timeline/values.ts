// SPDX-License-Identifier: Apache-2.0
import type { Series } from "../model/series.ts";

const nearest_s = 5; // a value further away says nothing of this time

/** The value of the last stamp that is not after `time`; null if there is none near. */
export function nearestValue(series: Series, time: number): number | null {
  const index = series.indexFrom(time + 1e-6) - 1;
  if (index < 0 || time - series.times[index]! > nearest_s) return null;
  return series.values[index] ?? null;
}
