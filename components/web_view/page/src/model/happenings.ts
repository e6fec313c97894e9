// SPDX-License-Identifier: Apache-2.0
/** What happened on the drive, as lines for the list of events. */
import { distance, flat, type Pose2 } from "./geometry.ts";
import { Outcome, State, type CorrectionOutcome } from "./messages.ts";
import { metres, type Level } from "./state_line.ts";

export interface Entry {
  time: number;
  level: Level;
  text: string;
  detail: string;
  at: Pose2 | undefined; // in the map
}

export interface Correction {
  time: number;
  place: number;
  outcome: number;
  reason: string;
  before: Pose2;
  after: Pose2;
}

export function entryOfCorrection({ time, place, outcome, reason, before, after }: Correction): Entry {
  const common = { time, at: after };
  if (outcome === Outcome.applied)
    return { ...common, level: "good", text: `Place ${place} recognised`, detail: `position corrected by ${metres(distance(before, after))}` };
  if (outcome === Outcome.betterKnown)
    return { ...common, level: "idle", text: `Place ${place} recognised`, detail: "the pose was known better already" };
  return { ...common, at: before, level: "caution", text: `Place ${place} not believed`, detail: reason };
}

export function correctionOf(message: CorrectionOutcome, time: number): Correction {
  const { landmark_id, outcome, reason, before, after } = message;
  return { time, place: landmark_id, outcome, reason, before: flat(before), after: flat(after) };
}

const stateTexts: Record<number, [Level, string]> = {
  [State.starting]: ["idle", "Starting"],
  [State.unlocated]: ["caution", "Looking for a known place"],
  [State.tracking]: ["good", "Position known"],
  [State.compassOnly]: ["caution", "Stereo cameras see too little"],
  [State.lost]: ["bad", "Position lost"],
  [State.relocalised]: ["good", "Located by a place"],
  [State.stale]: ["bad", "No odometry"],
};

export function levelOfState(state: number): Level {
  return stateTexts[state]?.[0] ?? "idle";
}

export function entryOfState(state: number, reason: string, time: number, at: Pose2 | undefined): Entry {
  const [level, text] = stateTexts[state] ?? ["idle", `State ${state}`];
  return { time, level, text, detail: reason, at };
}
