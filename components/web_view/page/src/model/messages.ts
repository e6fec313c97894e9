// SPDX-License-Identifier: Apache-2.0
/** The members of the messages that the page reads. Units and frames: interfaces/idl. */

export interface Time {
  sec: number;
  nanosec: number;
}
export interface Header {
  stamp: Time;
  frame_id: string;
}
export interface Vector {
  x: number;
  y: number;
  z: number;
}
export interface Quaternion extends Vector {
  w: number;
}
export interface Pose {
  position: Vector;
  orientation: Quaternion;
}
export interface PoseWithCovariance {
  pose: Pose;
  covariance: ArrayLike<number>;
}
export interface Odometry {
  header: Header;
  pose: PoseWithCovariance;
  twist: { twist: { linear: Vector } };
}
export interface PathMessage {
  header: Header;
  poses: { header: Header; pose: Pose }[];
}
export interface OdometryQuality {
  header: Header;
  tracked: number;
  inliers: number;
  reliable: boolean;
  reason: string;
}
export interface AzimuthChange {
  header: Header;
  from_stamp: Time;
  azimuth_change_rad: number;
  valid: boolean;
}
export interface Landmark {
  header: Header;
  id: number;
  pose: PoseWithCovariance;
  is_junction: boolean;
  thumbnail: Uint8Array;
}
export interface LandmarkPoses {
  ids: ArrayLike<number>;
  poses: PoseWithCovariance[];
}
export interface LandmarkMatch {
  header: Header;
  state: number;
  reason: string;
  landmark_id: number;
  heading_rad: number;
}
export interface CorrectionOutcome {
  header: Header;
  landmark_id: number;
  outcome: number;
  reason: string;
  before: Pose;
  after: Pose;
}
export interface LocalizationState {
  header: Header;
  state: number;
  reason: string;
  position_sigma_m: number;
  heading_sigma_rad: number;
}
export interface Integrity {
  header: Header;
  usable: boolean;
  reason: string;
  risk: number;
  horizontal_protection_level_m: number;
  alert_limit_m: number;
}
export interface DiagnosticArray {
  header: Header;
  status: { level: number; name: string; message: string; values: { key: string; value: string }[] }[];
}
export interface Transforms {
  transforms: { child_frame_id: string; transform: { rotation: Quaternion } }[];
}

export const State = { starting: 1, unlocated: 2, tracking: 3, compassOnly: 4, lost: 5, relocalised: 6, stale: 7 } as const;
export const Match = { searching: 1, locked: 2, matched: 3, rejected: 4, unusable: 5 } as const;
export const Outcome = { applied: 1, betterKnown: 2, rejected: 3 } as const;

export const seconds = ({ sec, nanosec }: Time): number => sec + nanosec * 1e-9;
