// SPDX-License-Identifier: Apache-2.0
/** A short drive to be published: a quarter of a circle to the left, with odometry that drifts, a place, and a correction. */
import { Match, Outcome, State } from "../../src/model/messages.ts";
import { covariance, header, matchCloud, odometry, pointCloud, pose } from "../modules/make.ts";

export const topics = {
  "/odometry/enhanced": "nav_msgs/msg/Odometry",
  "/odometry/binocular": "nav_msgs/msg/Odometry",
  "/odometry/quality": "panvo_msgs/msg/OdometryQuality",
  "/localization/state": "panvo_msgs/msg/LocalizationState",
  "/localization/integrity": "panvo_msgs/msg/Integrity",
  "/landmarks/poses": "panvo_msgs/msg/LandmarkPoses",
  "/correction/outcome": "panvo_msgs/msg/CorrectionOutcome",
  "/diagnostics": "diagnostic_msgs/msg/DiagnosticArray",
  "/stereo/left/image_rect": "sensor_msgs/msg/Image",
  "/odometry/points": "sensor_msgs/msg/PointCloud2",
};

export const image = { width: 96, height: 72 };
export const point = { u: 60, v: 40 }; // of the odometry, in the image
export const poses = 120;
export const radius_m = 30;
const start_s = 1000;
const rate_hz = 10;

export function poseAt(i: number) {
  const angle = (i / (poses - 1)) * (Math.PI / 2);
  return { x: radius_m * Math.sin(angle), y: radius_m * (1 - Math.cos(angle)), yaw: angle };
}

const full = (xx: number) => {
  const values = covariance(xx, 0, xx);
  [values[14], values[21], values[28], values[35]] = [xx, 1e-4, 1e-4, 1e-4];
  return values;
};

const odometryAt = (i: number, frame: string, drift: number) => {
  const message = odometry(start_s + i / rate_hz, { ...poseAt(i), x: poseAt(i).x + drift }, 4);
  const zero = { x: 0, y: 0, z: 0 };
  return {
    header: header(start_s + i / rate_hz, frame),
    child_frame_id: "base_link",
    pose: { pose: message.pose.pose, covariance: full(0.0625) },
    twist: { twist: { linear: { ...zero, x: 4 }, angular: zero }, covariance: full(0.01) },
  };
};

/** The messages in the order in which they are published. */
export function* messages(): Generator<[keyof typeof topics, unknown]> {
  const end = start_s + (poses - 1) / rate_hz;
  yield ["/landmarks/poses", { header: header(start_s), ids: [7], poses: [{ pose: pose({ x: 10, y: 20, yaw: 0 }), covariance: full(0.01) }] }];
  for (let i = 0; i < poses; ++i) {
    yield ["/odometry/binocular", odometryAt(i, "odom", (i / (poses - 1)) * 1.5)];
    yield ["/odometry/enhanced", odometryAt(i, "map", 0)];
    yield ["/odometry/quality", { header: header(start_s + i / rate_hz, "odom"), detected: 300, tracked: 200, matched: 180, inliers: 150, inlier_ratio: 0.8, residual_px: 0.5, reliable: true, reason: "" }];
  }
  yield ["/correction/outcome", { header: header(end), landmark_id: 7, outcome: Outcome.applied, reason: "", chi_square: 3, before: pose({ x: 29, y: 30, yaw: 1.57 }), after: pose({ x: 30, y: 30, yaw: 1.57 }) }];
  yield ["/localization/state", { header: header(end), state: State.tracking, reason: "", since: header(end).stamp, position_sigma_m: 0.25, heading_sigma_rad: 0.01 }];
  yield ["/localization/integrity", { header: header(end), usable: true, reason: "", risk: 0.001, horizontal_protection_level_m: 1.37, alert_limit_m: 2 }];
  yield ["/diagnostics", { header: header(end, ""), status: [{ level: 1, name: "panvo: localizer", message: "too slow", hardware_id: "none", values: [{ key: "/correction messages", value: "9 received, 6 handled, 3 dropped, 0 waiting, 0 undecodable" }] }] }];
  const red = Array.from({ length: image.width * image.height }, () => [0, 0, 250]).flat();
  yield ["/stereo/left/image_rect", { header: header(end, "left"), ...image, encoding: "bgr8", is_bigendian: 0, step: 3 * image.width, data: new Uint8Array(red) }];
  yield ["/odometry/points", pointCloud(end, [{ ...point, track: 5, state: 1 }])];
}

export const placeTopics = {
  "/panorama/image": "sensor_msgs/msg/Image",
  "/landmarks": "panvo_msgs/msg/PanoramicLandmark",
  "/landmarks/match": "panvo_msgs/msg/LandmarkMatch",
  "/landmarks/match_points": "sensor_msgs/msg/PointCloud2",
};

export const panorama = { width: 64, height: 32 };
/** In the middle of the panorama; when the place was built it was seen a quarter of a turn further right. */
export const seenPoint = { u: 0.5, v: 0.55, place_u: 0.25, place_v: 0.55, state: 1 };

/** Place 7 is seen again, with the vehicle turned by a quarter to the left. `thumbnail`: JPEG of the place. */
export function* placeMessages(thumbnail: Uint8Array): Generator<[keyof typeof placeTopics, unknown]> {
  const time = start_s + (poses - 1) / rate_hz;
  const { position, orientation } = pose({ x: 10, y: 20, yaw: 0 });
  const landmark = { header: header(start_s), id: 7, pose: { pose: { position, orientation }, covariance: full(0.01) }, panorama_pose: { position, orientation }, is_junction: false, settings: "" };
  yield ["/landmarks", { ...landmark, histogram: [], large_features: [], small_features: [], keypoints: [], thumbnail }];
  const grey = new Uint8Array(panorama.width * panorama.height).fill(90);
  yield ["/panorama/image", { header: header(time, "panorama"), ...panorama, encoding: "mono8", is_bigendian: 0, step: panorama.width, data: grey }];
  const distances = { histogram_distance: 0.1, large_distance: 0.2, small_distance: 0.2, candidates: 1, kept_after_histogram: 1, kept_after_large: 1 };
  yield ["/landmarks/match", { header: header(time, "panorama"), state: Match.locked, reason: "", landmark_id: 7, heading_rad: Math.PI / 2, ...distances }];
  yield ["/landmarks/match_points", matchCloud(time, 7, [seenPoint, { ...seenPoint, u: 0.8, state: 2 }])];
}
