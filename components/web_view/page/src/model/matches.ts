// SPDX-License-Identifier: Apache-2.0
/** Points of a recognised place: where the panorama shows them, and where the picture of the place does. */
import { seconds } from "./messages.ts";
import { pointsOf, type PointCloud } from "./point_cloud.ts";

export interface MatchedPoint {
  u: number; // fraction of the width of the panorama
  v: number; // of its height
  placeU: number; // the same in the picture of the place
  placeV: number;
  agrees: boolean; // with the pose
}

export interface Matches {
  time: number; // of the panorama, s
  place: number;
  points: MatchedPoint[];
}

const agrees = 1; // as in the position corrector's points

/** Undefined if the cloud is not one of matched points, or has none. */
export function matchesOf(cloud: PointCloud): Matches | undefined {
  const points = pointsOf(cloud, ["u", "v", "place_u", "place_v", "landmark", "state"]);
  if (!points || points.length === 0) return undefined;
  return {
    time: seconds(cloud.header.stamp),
    place: points[0]!.landmark,
    points: points.map(({ u, v, place_u, place_v, state }) => ({ u, v, placeU: place_u, placeV: place_v, agrees: state === agrees })),
  };
}
