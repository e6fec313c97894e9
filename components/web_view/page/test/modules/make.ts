// SPDX-License-Identifier: Apache-2.0
/** Messages for tests. */
import type { Pose2 } from "../../src/model/geometry.ts";
import { covariance6 as covariance, headerOf as header, poseOf as pose, stampOf as stamp } from "../../src/model/message_parts.ts";

export { covariance, header, pose, stamp };

export function odometry(seconds: number, at: Pose2, speed = 0) {
  return { header: header(seconds), pose: { pose: pose(at), covariance: covariance(0.04, 0, 0.01) }, twist: { twist: { linear: { x: speed, y: 0, z: 0 } } } };
}

type Layout = readonly (readonly [name: string, offset: number, datatype: number])[];

function cloudOf(seconds: number, frame: string, step: number, layout: Layout, points: Record<string, number>[]) {
  const data = new Uint8Array(step * points.length);
  const view = new DataView(data.buffer);
  points.forEach((point, i) => {
    for (const [name, offset, datatype] of layout) {
      const at = i * step + offset;
      const value = point[name] ?? 0;
      if (datatype === 7) view.setFloat32(at, value, true);
      else if (datatype === 6) view.setUint32(at, value, true);
      else view.setUint8(at, value);
    }
  });
  return {
    header: header(seconds, frame),
    height: 1,
    width: points.length,
    fields: layout.map(([name, offset, datatype]) => ({ name, offset, datatype, count: 1 })),
    is_bigendian: false,
    point_step: step,
    row_step: data.length,
    data,
    is_dense: true,
  };
}

/** Points as the odometry publishes them, in its layout. */
export function pointCloud(seconds: number, points: { u: number; v: number; track: number; state: number }[]) {
  return cloudOf(seconds, "odom", 28, [["x", 0, 7], ["y", 4, 7], ["z", 8, 7], ["u", 12, 7], ["v", 16, 7], ["track", 20, 6], ["state", 24, 2]], points);
}

const matchLayout: Layout = [["x", 0, 7], ["y", 4, 7], ["z", 8, 7], ["u", 12, 7], ["v", 16, 7], ["place_u", 20, 7], ["place_v", 24, 7], ["landmark", 28, 6], ["state", 32, 2]];

/** Points as the position corrector publishes them, in its layout. */
export function matchCloud(seconds: number, landmark: number, points: { u: number; v: number; place_u: number; place_v: number; state: number }[]) {
  return cloudOf(seconds, "panorama", 36, matchLayout, points.map((point) => ({ ...point, landmark })));
}

export function near(actual: number, expected: number, tolerance = 1e-9): void {
  if (!(Math.abs(actual - expected) <= tolerance)) throw new Error(`${actual} is not ${expected} within ${tolerance}`);
}
