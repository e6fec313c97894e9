// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { State, type Integrity, type LocalizationState, type OdometryQuality } from "../../src/model/messages.ts";
import { metres, stateLine } from "../../src/model/state_line.ts";
import { spansOf } from "../../src/timeline/state_strip.ts";
import { header } from "./make.ts";

const state = (value: number, reason = ""): LocalizationState => ({ header: header(0), state: value, reason, position_sigma_m: 0.123, heading_sigma_rad: 0 });
const integrity = (usable: boolean, reason = ""): Integrity => ({ header: header(0), usable, reason, risk: 0.001, horizontal_protection_level_m: 0.78, alert_limit_m: 2 });

test("a known position is shown with its uncertainty", () => {
  assert.deepEqual(stateLine({ state: state(State.tracking), integrity: integrity(true) }), {
    level: "good", title: "Position known", reason: "within 0.78 m at 99.9 % confidence",
  });
  assert.equal(stateLine({ state: state(State.tracking) }).reason, "standard deviation 0.12 m");
});

test("a pose that is not usable is not called known", () => {
  const line = stateLine({ state: state(State.tracking), integrity: integrity(false, "protection level 3 m exceeds 2 m") });
  assert.deepEqual(line, { level: "caution", title: "Do not rely on the position", reason: "protection level 3 m exceeds 2 m" });
});

test("each state has its level, and the reason of the message is shown", () => {
  const levels = Object.entries(State).map(([name, value]) => [name, stateLine({ state: state(value, "why") }).level]);
  assert.deepEqual(Object.fromEntries(levels), {
    starting: "idle", unlocated: "caution", tracking: "good", compassOnly: "caution", lost: "bad", relocalised: "good", stale: "bad",
  });
  assert.equal(stateLine({ state: state(State.lost, "no inliers") }).reason, "no inliers");
  assert.equal(stateLine({ state: state(99) }).level, "idle");
});

test("old data are marked old, whatever their state", () => {
  assert.equal(stateLine({ state: state(State.tracking), silent_s: 4.2 }).reason, "the last pose came 4 s ago");
  assert.equal(stateLine({ state: state(State.tracking), silent_s: 9, isPaused: true }).title, "Paused");
  assert.equal(stateLine({ state: state(State.tracking), silent_s: 9, isPaused: true, link: "lost" }).title, "Server lost");
});

test("without a localizer the state is that of the odometry", () => {
  const quality: OdometryQuality = { header: header(0), tracked: 10, inliers: 2, reliable: false, reason: "2 inliers of 20" };
  assert.deepEqual(stateLine({ quality }), { level: "bad", title: "Stereo odometry unreliable", reason: "2 inliers of 20" });
  assert.equal(stateLine({}).title, "No vehicle yet");
  assert.equal(stateLine({ link: "connecting" }).title, "Connecting");
  assert.equal(stateLine({ link: "lost" }).title, "Server not reached");
});

test("lengths are rounded to significant digits", () => {
  assert.deepEqual([0.051, 12.34, 345.6, NaN].map(metres), ["0.05 m", "12.3 m", "346 m", "–"]);
});

test("spans of equal level are joined, and what is not usable is not good", () => {
  const states = [
    { time: 0, state: State.starting, usable: true },
    { time: 1, state: State.tracking, usable: true },
    { time: 3, state: State.relocalised, usable: true },
    { time: 5, state: State.tracking, usable: false },
  ];
  assert.deepEqual(spansOf({ states }, 9), [
    { from: 0, to: 1, level: "idle" },
    { from: 1, to: 5, level: "good" },
    { from: 5, to: 9, level: "caution" },
  ]);
});
