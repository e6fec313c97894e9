// SPDX-License-Identifier: Apache-2.0
import type { RecordedDrive } from "../../src/model/recorded_drive.ts";

/** 10 s to the east at 1 m/s; the odometry drifts to the left by a tenth of the way, and a place seen at 8 s takes that away. */
export function recordedStreet(): RecordedDrive {
  const times = Array.from({ length: 101 }, (_, i) => i / 10);
  return {
    version: 1,
    title: "a street",
    report: "<!doctype html><h1>Error after 10 m</h1>",
    truth: times.map((time) => [time, time, 0, 0]),
    binocular: times.map((time) => [time, time, time / 10, 0]),
    enhanced: times.map((time) => [time, time, time < 8 ? time / 10 : 0, 0, 0.04, 0, 0.01, 1]),
    quality: times.map((time) => [time, true, 200, 150]),
    azimuth: [[2, 1, 0]],
    places: [{ time: 3, id: 7, junction: true, pose: [3, 0, Math.PI / 2], thumbnail: "" }],
    matches: [[8, "matched", 7, -Math.PI / 2]],
    outcomes: [[8, 7, "applied", "", [8, 0.8, 0], [8, 0, 0]]],
    states: [[0, "tracking", "", 0.1, 0.01], [6, "compass_only", "a bus", 0.3, 0.01], [9, "tracking", "", 0.1, 0.01]],
    integrity: [[0, true, "", 0.001, 1, 2]],
    pictures: { left: [], panorama: [] },
    panoramaYaw: 0.5,
  };
}
