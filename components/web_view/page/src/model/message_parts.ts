// SPDX-License-Identifier: Apache-2.0
/** Parts of messages, made from numbers. */
import type { Pose2 } from "./geometry.ts";
import type { Header, Pose, Time } from "./messages.ts";

export const stampOf = (seconds: number): Time => ({ sec: Math.floor(seconds), nanosec: Math.round((seconds - Math.floor(seconds)) * 1e9) });
export const headerOf = (seconds: number, frame_id = "map"): Header => ({ stamp: stampOf(seconds), frame_id });

export function poseOf({ x, y, yaw }: Pose2): Pose {
  return { position: { x, y, z: 0 }, orientation: { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) } };
}

/** A pose's covariance of which only the position in the plane is known, m². */
export function covariance6(xx: number, xy: number, yy: number): number[] {
  const values = new Array<number>(36).fill(0);
  [values[0], values[1], values[6], values[7]] = [xx, xy, xy, yy];
  return values;
}
