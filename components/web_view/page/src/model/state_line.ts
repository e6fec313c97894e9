// SPDX-License-Identifier: Apache-2.0
/** The state in one line, for somebody who drives: what to do with the position, and why. */
import { State, type Integrity, type LocalizationState, type OdometryQuality } from "./messages.ts";

/** good: use the position; caution: use it with care; bad: do not use it; idle: no position yet. */
export type Level = "good" | "caution" | "bad" | "idle";

export interface StateLine {
  level: Level;
  title: string;
  reason: string;
}

export interface Known {
  state?: LocalizationState | undefined;
  integrity?: Integrity | undefined;
  quality?: OdometryQuality | undefined;
  silent_s?: number; // since the last pose arrived here
  link?: "connecting" | "open" | "lost" | "snapshot"; // the connection to the server
  isPaused?: boolean; // the bag that is played
}

const silence_s = 3;

export function metres(value: number): string {
  if (!Number.isFinite(value)) return "–";
  if (value >= 100) return `${Math.round(value)} m`;
  return value >= 10 ? `${value.toFixed(1)} m` : `${value.toFixed(2)} m`;
}

/** 0.001: "99.9 %". */
function confidence(risk: number): string {
  const digits = Math.min(7, Math.max(0, Math.ceil(-Math.log10(risk) - 1e-9) - 2));
  return `${(100 * (1 - risk)).toFixed(digits)} %`;
}

function located(title: string, { reason, position_sigma_m }: LocalizationState, integrity: Integrity | undefined): StateLine {
  if (integrity && !integrity.usable) return { level: "caution", title: "Do not rely on the position", reason: integrity.reason };
  const within = integrity
    ? `within ${metres(integrity.horizontal_protection_level_m)} at ${confidence(integrity.risk)} confidence`
    : `standard deviation ${metres(position_sigma_m)}`;
  return { level: "good", title, reason: reason === "" ? within : `${within}; ${reason}` };
}

export function stateLine({ state, integrity, quality, silent_s = 0, link = "open", isPaused = false }: Known): StateLine {
  const isKnown = state !== undefined || quality !== undefined;
  if (isKnown && (link === "lost" || link === "connecting"))
    return { level: "bad", title: "Server lost", reason: `what is shown is ${Math.floor(silent_s)} s old` };
  if (link === "lost") return { level: "bad", title: "Server not reached", reason: "nothing was received yet" };
  if (link === "connecting") return { level: "idle", title: "Connecting", reason: "" };
  if (isPaused) return { level: "idle", title: "Paused", reason: "the bag waits" };
  if (!state) {
    if (!quality) return { level: "idle", title: "No vehicle yet", reason: "no localization state is published" };
    return quality.reliable
      ? { level: "caution", title: "Stereo odometry alone", reason: "no map: the position drifts with the way driven" }
      : { level: "bad", title: "Stereo odometry unreliable", reason: quality.reason };
  }
  if (silent_s > silence_s)
    return { level: "idle", title: "No new data", reason: `the last pose came ${Math.floor(silent_s)} s ago` };
  const because = (fallback: string) => state.reason || fallback;
  switch (state.state) {
    case State.starting:
      return { level: "idle", title: "Starting", reason: because("waiting for the first stereo images") };
    case State.unlocated:
      return { level: "caution", title: "Looking for a known place", reason: because("the start in the map is not known yet") };
    case State.tracking:
      return located("Position known", state, integrity);
    case State.relocalised:
      return located("Position known, place recognised", state, integrity);
    case State.compassOnly:
      return { level: "caution", title: "Stereo cameras see too little", reason: because("the panorama gives the heading; the position is estimated") };
    case State.lost:
      return { level: "bad", title: "Position lost", reason: because("do not use it until a place is recognised") };
    case State.stale:
      return { level: "bad", title: "No odometry", reason: because("the stereo cameras send nothing") };
    default:
      return { level: "idle", title: `State ${state.state}`, reason: because("unknown to this page") };
  }
}
