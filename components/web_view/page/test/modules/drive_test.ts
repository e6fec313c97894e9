// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import type { Role } from "../../src/link/roles.ts";
import { Drive } from "../../src/model/drive.ts";
import { composed, type Pose2 } from "../../src/model/geometry.ts";
import { Match, Outcome, State } from "../../src/model/messages.ts";
import { restoreSnapshot, takeSnapshot } from "../../src/model/snapshot.ts";
import { header, near, odometry, pose, stamp } from "./make.ts";

const take = (drive: Drive, role: Role, message: unknown) => drive.take({ role, topic: `/${role}`, message });

/** Drives along x at 2 m/s; the odometry, in a frame of its own, drifts to the left by 1 cm a pose. */
function driven(poses: number): Drive {
  const drive = new Drive();
  const odomFromMap: Pose2 = { x: 5, y: 5, yaw: Math.PI / 2 };
  for (let i = 0; i < poses; ++i) {
    const time = 100 + i * 0.1;
    take(drive, "binocular", odometry(time, composed(odomFromMap, { x: i * 0.2, y: i * 0.01, yaw: 0 }), 2));
    take(drive, "truth", odometry(time, { x: 50 + i * 0.2, y: -0.002 * i, yaw: 0 }));
    take(drive, "enhanced", odometry(time, { x: i * 0.2, y: 0, yaw: 0 }, 2));
  }
  return drive;
}

test("poses, way, speed and uncertainty are those of the messages", () => {
  const drive = driven(101);
  assert.equal(drive.enhanced.received, 101);
  near(drive.pose!.x, 20, 1e-9);
  near(drive.driven_m, 20, 0.3);
  assert.equal(drive.speed, 2);
  near(drive.ellipse!.major, 0.2);
  near(drive.now - drive.begin, 10, 1e-6);
});

test("drift and error count from where the paths began together", () => {
  const drive = driven(101);
  near(drive.drift_m, 1, 1e-6);
  near(drive.error_m, 0.2, 1e-6);
});

test("poses of a path message are inserted before those already received", () => {
  const drive = driven(3);
  const poses = [90, 91, 100.05].map((time, i) => ({ header: header(time), pose: pose({ x: i - 10, y: 0, yaw: 0 }) }));
  take(drive, "pathEnhanced", { header: header(101), poses });
  assert.deepEqual([...drive.enhanced.times.subarray(0, drive.enhanced.count)], [90, 91, 100, 100.1, 100.2]);
  assert.equal(drive.begin, 90);
});

const landmark = (id: number, x: number, time: number) => ({ header: header(time), id, pose: { pose: pose({ x, y: 0, yaw: 0 }), covariance: [] }, is_junction: true, thumbnail: new Uint8Array([1, 2, 3]) });
const outcome = (time: number, kind: number, before: number, after: number) => ({
  header: header(time), landmark_id: 1, outcome: kind, reason: "unsure", before: pose({ x: before, y: 0, yaw: 0 }), after: pose({ x: after, y: 0, yaw: 1 }),
});

test("the sightings of one pass are one line in the list", () => {
  const drive = driven(10);
  take(drive, "landmark", landmark(1, 3, 100.5));
  take(drive, "outcome", outcome(101, Outcome.rejected, 0, 0));
  take(drive, "outcome", outcome(101.2, Outcome.applied, 1, 1.5));
  take(drive, "outcome", outcome(101.4, Outcome.applied, 1.5, 1.6));
  take(drive, "outcome", outcome(120, Outcome.betterKnown, 2, 2));
  assert.deepEqual(drive.entries.map(({ text, detail }) => [text, detail]), [
    ["Place 1 remembered", "a junction"],
    ["Place 1 recognised", "position corrected by 0.50 m, 0.10 m"],
    ["Place 1 recognised", "the pose was known better already"],
  ]);
  assert.equal(drive.places.all.get(1)!.corrections, 2);
});

test("places move with landmarks/poses, in whatever order the messages come", () => {
  const drive = new Drive();
  take(drive, "landmarkPoses", { ids: [1], poses: [{ pose: pose({ x: 7, y: 0, yaw: 0 }), covariance: [] }] });
  take(drive, "landmark", landmark(1, 3, 100));
  assert.equal(drive.places.all.get(1)!.pose.x, 7);
  take(drive, "landmarkPoses", { ids: [1], poses: [{ pose: pose({ x: 8, y: 0, yaw: 0 }), covariance: [] }] });
  assert.equal(drive.places.all.get(1)!.pose.x, 8);
});

test("a match names the recognised place and the heading", () => {
  const drive = new Drive();
  take(drive, "match", { header: header(5), state: Match.locked, reason: "", landmark_id: 4, heading_rad: 1.5 });
  take(drive, "match", { header: header(6), state: Match.searching, reason: "", landmark_id: 0, heading_rad: 0 });
  assert.deepEqual(drive.recognised, { place: 4, heading: 1.5, time: 5 });
});

test("the turn of the compass is compared with that of the odometry", () => {
  const drive = new Drive();
  take(drive, "azimuth", { header: header(1.2), from_stamp: stamp(1), azimuth_change_rad: 0.1, valid: true });
  for (const [time, yaw] of [[1, 3.1], [1.1, 3.15], [1.2, -3.1]] as const) take(drive, "binocular", odometry(time, { x: 0, y: 0, yaw }));
  near(drive.series.compass.last!, (0.1 / 0.2) * (180 / Math.PI), 1e-6);
  near(drive.series.odometry.last!, ((2 * Math.PI - 6.2) / 0.2) * (180 / Math.PI), 1e-6);
});

test("a change of the state is listed once", () => {
  const drive = driven(2);
  const state = (time: number, value: number, reason = "") => take(drive, "state", { header: header(time), state: value, reason, position_sigma_m: 0, heading_sigma_rad: 0 });
  state(100, State.tracking);
  state(100.5, State.tracking);
  state(101, State.lost, "dark");
  assert.deepEqual(drive.entries.map(({ text, detail }) => [text, detail]), [["Position known", ""], ["Position lost", "dark"]]);
  assert.deepEqual(drive.states.map(({ time }) => time), [100, 101]);
});

test("replaying a bag begins a new drive", () => {
  const drive = driven(50);
  take(drive, "binocular", odometry(100, { x: 0, y: 0, yaw: 0 }));
  take(drive, "enhanced", odometry(100, { x: 0, y: 0, yaw: 0 }));
  assert.deepEqual([drive.enhanced.count, drive.binocular.count], [1, 1]);
  assert.equal(drive.driven_m, 0);
  assert.equal(drive.now, 100);
});

test("another run of the system begins with nothing of the one before", () => {
  const drive = driven(20);
  const { version } = drive;
  drive.startAnew();
  assert.deepEqual([drive.enhanced.count, drive.truth.count, drive.binocular.count, drive.entries.length], [0, 0, 0, 0]);
  assert.ok(drive.version > version);
  take(drive, "binocular", odometry(200, { x: 70, y: 0, yaw: 0 }, 1));
  take(drive, "enhanced", odometry(200, { x: 30, y: 0, yaw: 0 }, 1));
  assert.equal(drive.driven_m, 0);
  near(drive.drift_m, 0, 1e-9);
  assert.equal(drive.begin, 200);
});

test("a bag that is moved back keeps what lies before", () => {
  const drive = driven(600);
  take(drive, "landmark", landmark(1, 3, 101));
  take(drive, "outcome", outcome(110, Outcome.applied, 1, 1.5));
  take(drive, "outcome", outcome(150, Outcome.applied, 1, 1.5));
  take(drive, "enhanced", odometry(130, { x: 60, y: 0, yaw: 0 }, 2));
  take(drive, "binocular", odometry(130, { x: 2, y: 65, yaw: 0 }, 2));
  assert.deepEqual([drive.enhanced.count, drive.truth.count, drive.binocular.count], [301, 300, 301]);
  assert.deepEqual([drive.begin, drive.now, drive.corrections.length, drive.entries.length], [100, 130, 1, 2]);
  assert.equal(drive.places.all.get(1)!.corrections, 1);
  near(drive.driven_m, 60, 0.5);
  near(drive.enhanced.bounds().right, 60, 1e-6);
  assert.ok(drive.series.speed.times.at(-1)! <= 130);
});

test("a snapshot restores the drive", () => {
  const drive = driven(30);
  take(drive, "landmark", landmark(1, 3, 100.5));
  take(drive, "outcome", outcome(101.2, Outcome.applied, 1, 1.5));
  const text = JSON.stringify(takeSnapshot(drive, {}, "pano", new Date(0)));
  const restored = new Drive();
  restoreSnapshot(restored, JSON.parse(text));
  assert.equal(restored.enhanced.count, 30);
  near(restored.pose!.x, drive.pose!.x, 1e-4);
  near(restored.drift_m, drive.drift_m, 1e-3);
  assert.deepEqual(restored.entries, drive.entries);
  assert.deepEqual([...restored.places.all.get(1)!.thumbnail!], [1, 2, 3]);
  near(restored.series.speed.last!, 2);
  near(restored.driven_m, drive.driven_m);
});
