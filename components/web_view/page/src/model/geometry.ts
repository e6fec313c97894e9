// SPDX-License-Identifier: Apache-2.0
/** Poses in the plane: x and y in m, yaw in rad, left positive. */
import type { Pose, Quaternion } from "./messages.ts";

export interface Pose2 {
  x: number;
  y: number;
  yaw: number;
}

export const identity: Pose2 = { x: 0, y: 0, yaw: 0 };

/** In [-pi, pi). */
export function wrapped(angle: number): number {
  return angle - 2 * Math.PI * Math.floor((angle + Math.PI) / (2 * Math.PI));
}

export function yawOf({ x, y, z, w }: Quaternion): number {
  return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

export function flat(pose: Pose): Pose2 {
  return { x: pose.position.x, y: pose.position.y, yaw: yawOf(pose.orientation) };
}

/** a_from_b times b_from_c. */
export function composed(a: Pose2, b: Pose2): Pose2 {
  const cos = Math.cos(a.yaw);
  const sin = Math.sin(a.yaw);
  return { x: a.x + cos * b.x - sin * b.y, y: a.y + sin * b.x + cos * b.y, yaw: wrapped(a.yaw + b.yaw) };
}

export function inverse({ x, y, yaw }: Pose2): Pose2 {
  const cos = Math.cos(yaw);
  const sin = Math.sin(yaw);
  return { x: -cos * x - sin * y, y: sin * x - cos * y, yaw: -yaw };
}

export const distance = (a: { x: number; y: number }, b: { x: number; y: number }): number => Math.hypot(a.x - b.x, a.y - b.y);

/** Axes of the ellipse of one standard deviation, m, and the direction of the longer one, rad. */
export interface Ellipse {
  major: number;
  minor: number;
  angle: number;
}

/** Horizontal error ellipse from a row-major 6x6 pose covariance. Undefined if the matrix is not a valid covariance. */
export function ellipseOf(covariance: ArrayLike<number>): Ellipse | undefined {
  const xx = covariance[0] ?? NaN;
  const xy = covariance[1] ?? NaN;
  const yy = covariance[7] ?? NaN;
  const mean = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  if (!(mean - spread >= -1e-12) || !Number.isFinite(mean)) return undefined;
  return {
    major: Math.sqrt(mean + spread),
    minor: Math.sqrt(Math.max(0, mean - spread)),
    angle: Math.atan2(2 * xy, xx - yy) / 2,
  };
}

/** Radius of the ellipse with 95 % of a two-dimensional normal distribution, in standard deviations. */
export const ninetyFivePercent = 2.4477;
