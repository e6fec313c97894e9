// SPDX-License-Identifier: Apache-2.0
import type { Pose2 } from "../model/geometry.ts";

const position_sigma_m = 0.5; // as RViz's tool assumes
const yaw_sigma_rad = 0.26;

/** geometry_msgs/PoseWithCovarianceStamped in the map, as of RViz's "2D Pose Estimate". */
export function initialPose({ x, y, yaw }: Pose2) {
  const covariance = new Array<number>(36).fill(0);
  covariance[0] = covariance[7] = position_sigma_m ** 2;
  covariance[35] = yaw_sigma_rad ** 2;
  return {
    header: { stamp: { sec: 0, nanosec: 0 }, frame_id: "map" }, // stamp 0: now
    pose: {
      pose: { position: { x, y, z: 0 }, orientation: { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) } },
      covariance,
    },
  };
}
