// SPDX-License-Identifier: Apache-2.0
/** Points that the odometry follows in the left image. */
import { seconds } from "./messages.ts";
import { pointsOf, type PointCloud } from "./point_cloud.ts";

/** As in the odometry's points. */
export const FeatureState = { new: 0, inlier: 1, outlier: 2 } as const;

export interface Feature {
  track: number; // the same point in all frames
  u: number; // px
  v: number;
  state: number;
}
export interface Features {
  time: number; // of the image, s
  points: Feature[];
}

/** Undefined if the cloud is not one of image points. */
export function featuresOf(cloud: PointCloud): Features | undefined {
  const points = pointsOf(cloud, ["track", "u", "v", "state"]);
  return points && { time: seconds(cloud.header.stamp), points };
}

/** A point, where it is and where it was in the frames before, newest first. */
export interface Trail {
  state: number;
  way: { u: number; v: number }[];
}

const same_s = 1e-4; // stamps of one image

/** The points of the last frames. */
export class FeatureTrails {
  newest = -Infinity; // time of the last frame, s
  #frames: { time: number; points: Map<number, Feature> }[] = []; // newest first

  constructor(readonly length = 8) {}

  add({ time, points }: Features): void {
    if (time < this.newest) this.#frames = [];
    this.newest = time;
    this.#frames.unshift({ time, points: new Map(points.map((point) => [point.track, point])) });
    this.#frames.length = Math.min(this.#frames.length, 2 * this.length); // an image may come later than its points
  }

  /** Of the points in the image of that time; undefined if they are not known. */
  at(time: number): Trail[] | undefined {
    const from = this.#frames.findIndex((frame) => Math.abs(frame.time - time) < same_s);
    if (from < 0) return undefined;
    const frames = this.#frames.slice(from, from + this.length);
    return [...frames[0]!.points.values()].map(({ track, state }) => {
      const way: Feature[] = [];
      for (const { points } of frames) {
        const point = points.get(track);
        if (!point) break;
        way.push(point);
      }
      return { state, way };
    });
  }
}
