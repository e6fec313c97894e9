// SPDX-License-Identifier: Apache-2.0
/** What was known at one time of a drive. */
import type { Drive } from "./drive.ts";
import { wrapped, type Pose2 } from "./geometry.ts";

export interface Moment {
  time: number;
  pose: Pose2 | undefined;
  recognised: Drive["recognised"]; // the last one until then
}

/** `time`: undefined: now. */
export function momentOf(drive: Drive, time: number | undefined): Moment {
  if (time === undefined) return { time: drive.now, pose: drive.pose, recognised: drive.recognised };
  const path = drive.enhanced.count > 0 ? drive.enhanced : drive.binocular;
  const index = path.indexAt(time);
  const seen = drive.corrections.filter((correction) => correction.time <= time).at(-1);
  const place = seen && drive.places.all.get(seen.place);
  return {
    time,
    pose: index < 0 ? undefined : path.at(index),
    recognised: seen && place && { place: place.id, heading: wrapped(seen.after.yaw - place.pose.yaw), time: seen.time },
  };
}
