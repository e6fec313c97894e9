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

/** What a sighting led to, in a few words. */
export function outcomeText({ outcome, before, after, reason }: Correction): string {
  if (outcome === Outcome.applied) return `corrected by ${metres(distance(before, after))}`;
  return outcome === Outcome.betterKnown ? "seen, pose was known better" : `not used${reason ? `: ${reason}` : ""}`;
}

/** One line for a pass by a place, during which it is seen several times. */
export function entryOfPass(pass: Correction[]): Entry {
  const { time, place, after, before, reason } = pass[pass.length - 1]!;
  const applied = pass.filter(({ outcome }) => outcome === Outcome.applied);
  if (applied.length > 0) {
    const steps = applied.map((one) => metres(distance(one.before, one.after))).join(", ");
    return { time, at: after, level: "good", text: `Place ${place} recognised`, detail: `position corrected by ${steps}` };
  }
  if (pass.some(({ outcome }) => outcome === Outcome.betterKnown))
    return { time, at: after, level: "idle", text: `Place ${place} recognised`, detail: "the pose was known better already" };
  return { time, at: before, level: "caution", text: `Place ${place} seen, not used`, detail: reason };
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
