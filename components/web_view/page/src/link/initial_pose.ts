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

const poseStamped = `std_msgs/Header header
geometry_msgs/PoseWithCovariance pose
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: geometry_msgs/PoseWithCovariance
geometry_msgs/Pose pose
float64[36] covariance
================================================================================
MSG: geometry_msgs/Pose
geometry_msgs/Point position
geometry_msgs/Quaternion orientation
================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
`;

/** Definitions of what the page itself publishes, by type. */
export const publishable: Record<string, string> = { "geometry_msgs/msg/PoseWithCovarianceStamped": poseStamped };
