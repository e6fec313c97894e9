// SPDX-License-Identifier: Apache-2.0
/** What the topics of panvo mean to the page. */
import type { Channel } from "./wire.ts";

interface Wanted {
  name: string;
  type: string;
}

/** Names without namespace, as in interfaces/include/panvo/interfaces/topics.hpp. */
export const roles = {
  enhanced: { name: "odometry/enhanced", type: "nav_msgs/msg/Odometry" },
  binocular: { name: "odometry/binocular", type: "nav_msgs/msg/Odometry" },
  truth: { name: "ground_truth/odometry", type: "nav_msgs/msg/Odometry" },
  quality: { name: "odometry/quality", type: "panvo_msgs/msg/OdometryQuality" },
  points: { name: "odometry/points", type: "sensor_msgs/msg/PointCloud2" },
  azimuth: { name: "compass/azimuth_change", type: "panvo_msgs/msg/AzimuthChange" },
  landmark: { name: "landmarks", type: "panvo_msgs/msg/PanoramicLandmark" },
  landmarkPoses: { name: "landmarks/poses", type: "panvo_msgs/msg/LandmarkPoses" },
  match: { name: "landmarks/match", type: "panvo_msgs/msg/LandmarkMatch" },
  matchPoints: { name: "landmarks/match_points", type: "sensor_msgs/msg/PointCloud2" },
  outcome: { name: "correction/outcome", type: "panvo_msgs/msg/CorrectionOutcome" },
  state: { name: "localization/state", type: "panvo_msgs/msg/LocalizationState" },
  integrity: { name: "localization/integrity", type: "panvo_msgs/msg/Integrity" },
  pathEnhanced: { name: "path/enhanced", type: "nav_msgs/msg/Path" },
  pathBinocular: { name: "path/binocular", type: "nav_msgs/msg/Path" },
  diagnostics: { name: "diagnostics", type: "diagnostic_msgs/msg/DiagnosticArray" },
  transforms: { name: "tf_static", type: "tf2_msgs/msg/TFMessage" },
} as const satisfies Record<string, Wanted>;

export type Role = keyof typeof roles;

/** The role of a channel: of a topic with that name in any namespace, and that type. */
export function roleOf(channel: Pick<Channel, "topic" | "schemaName">): Role | undefined {
  for (const [role, { name, type }] of Object.entries(roles)) {
    if (channel.schemaName === type && (`/${channel.topic}`.endsWith(`/${name}`))) return role as Role;
  }
  return undefined;
}

export const imageTypes = ["sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"];

/** The image topics to show first: rectified rather than raw; compressed unless the server is on this machine. */
export function preferredImage(topics: string[], kind: "left" | "panorama", isNear: boolean): string | undefined {
  const stems = kind === "left" ? ["stereo/left/image_rect", "stereo/left/image_raw"] : ["panorama/image"];
  for (const stem of stems) {
    const endings = [`${stem}/compressed`, stem];
    for (const ending of isNear ? endings.reverse() : endings) {
      const found = topics.find((topic) => `/${topic}`.endsWith(`/${ending}`));
      if (found !== undefined) return found;
    }
  }
  return topics.find((topic) => topic.includes(kind) && !topic.endsWith("mask"));
}
