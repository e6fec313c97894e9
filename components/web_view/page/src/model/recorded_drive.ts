// SPDX-License-Identifier: Apache-2.0
/** A drive that was recorded and evaluated, as `panvo evaluate journey` writes it into the page: rows of its results instead of messages. */
import type { Role } from "../link/roles.ts";
import type { Drive } from "./drive.ts";
import type { Pose2 } from "./geometry.ts";
import { headOf, Heads } from "./head.ts";
import * as m from "./messages.ts";
import { covariance6, headerOf, poseOf, stampOf } from "./message_parts.ts";

/** x and y in m, yaw in rad. Times: seconds since the first pose. */
type Pose = [x: number, y: number, yaw: number];

type Maybe = number | null; // null: unknown

export interface RecordedDrive {
  version: 1;
  title: string;
  report: string; // the page with all tables and plots, as HTML
  enhanced: [time: number, ...Pose, xx: Maybe, xy: Maybe, yy: Maybe, speed: number][]; // covariance of the position in m²
  binocular: [time: number, ...Pose][];
  truth: [time: number, ...Pose][];
  quality: [time: number, reliable: boolean, tracked: number, inliers: number][];
  azimuth: [time: number, from: number, change: number][]; // the valid ones
  places: { time: number; id: number; junction: boolean; pose: Pose; thumbnail: string }[]; // JPEG as base64; empty: none
  matches: [time: number, state: string, place: number, heading: number][]; // those with a heading
  outcomes: [time: number, place: number, outcome: string, reason: string, before: Pose, after: Pose][];
  states: [time: number, state: string, reason: string, position_sigma: Maybe, heading_sigma: Maybe][];
  integrity: [time: number, usable: boolean, reason: string, risk: Maybe, level: Maybe, alert: Maybe][];
  pictures: Record<"left" | "panorama", [time: number, jpeg: string][]>; // as base64
  panoramaYaw: number; // of the middle of the panorama in the vehicle
}

/** The frame that pictures of the panoramic camera get. */
export const panoramaFrame = "recorded panorama";

const states: Record<string, number> = { ...m.State, compass_only: m.State.compassOnly };
const outcomes: Record<string, number> = { ...m.Outcome, better_known: m.Outcome.betterKnown };
const matchStates: Record<string, number> = m.Match;

const known = (value: Maybe): number => value ?? NaN;
const pose2 = ([x, y, yaw]: Pose): Pose2 => ({ x, y, yaw });

function odometry(time: number, pose: Pose, covariance: ArrayLike<number> = [], speed = NaN): m.Odometry {
  return { header: headerOf(time), pose: { pose: poseOf(pose2(pose)), covariance }, twist: { twist: { linear: { x: speed, y: 0, z: 0 } } } };
}

/** The messages from which the rows were written, in the order of their stamps; of one stamp, in the order below. */
function messagesOf(recorded: RecordedDrive): [time: number, role: Role, message: unknown][] {
  const messages: [number, Role, unknown][] = [];
  const add = (role: Role, time: number, message: unknown) => void messages.push([time, role, message]);
  for (const [time, ...pose] of recorded.truth) add("truth", time, odometry(time, pose));
  for (const [time, ...pose] of recorded.binocular) add("binocular", time, odometry(time, pose));
  for (const [time, x, y, yaw, xx, xy, yy, speed] of recorded.enhanced) add("enhanced", time, odometry(time, [x, y, yaw], covariance6(known(xx), known(xy), known(yy)), speed));
  for (const [time, reliable, tracked, inliers] of recorded.quality) add("quality", time, { header: headerOf(time), reliable, tracked, inliers, reason: "" });
  for (const [time, from, change] of recorded.azimuth) add("azimuth", time, { header: headerOf(time), from_stamp: stampOf(from), azimuth_change_rad: change, valid: true });
  for (const { time, id, junction, pose, thumbnail } of recorded.places) {
    const bytes = Uint8Array.from(atob(thumbnail), (letter) => letter.charCodeAt(0));
    add("landmark", time, { header: headerOf(time), id, is_junction: junction, pose: { pose: poseOf(pose2(pose)), covariance: [] }, thumbnail: bytes });
  }
  for (const [time, state, place, heading] of recorded.matches)
    add("match", time, { header: headerOf(time), state: matchStates[state] ?? 0, reason: "", landmark_id: place, heading_rad: heading });
  for (const [time, place, outcome, reason, before, after] of recorded.outcomes)
    add("outcome", time, { header: headerOf(time), landmark_id: place, outcome: outcomes[outcome] ?? 0, reason, before: poseOf(pose2(before)), after: poseOf(pose2(after)) });
  for (const [time, state, reason, position, heading] of recorded.states)
    add("state", time, { header: headerOf(time), state: states[state] ?? 0, reason, position_sigma_m: known(position), heading_sigma_rad: known(heading) });
  for (const [time, usable, reason, risk, level, alert] of recorded.integrity)
    add("integrity", time, { header: headerOf(time), usable, reason, risk: known(risk), horizontal_protection_level_m: known(level), alert_limit_m: known(alert) });
  return messages.sort(([a], [b]) => a - b);
}

/** Returns the head of the page at each time of the drive. */
export function playInto(drive: Drive, recorded: RecordedDrive): Heads {
  drive.yawOfFrame.set(panoramaFrame, recorded.panoramaYaw);
  const heads = new Heads();
  const messages = messagesOf(recorded);
  messages.forEach(([time, role, message], i) => {
    drive.take({ role, topic: role, message });
    if (time !== messages[i + 1]?.[0]) heads.add(time, headOf(drive));
  });
  return heads;
}
