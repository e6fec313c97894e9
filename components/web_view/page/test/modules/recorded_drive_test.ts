// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { Drive } from "../../src/model/drive.ts";
import { State } from "../../src/model/messages.ts";
import { momentOf } from "../../src/model/moment.ts";
import { panoramaFrame, playInto } from "../../src/model/recorded_drive.ts";
import { near } from "./make.ts";
import { recordedStreet } from "./recorded_street.ts";

const played = () => {
  const drive = new Drive();
  playInto(drive, recordedStreet());
  return drive;
};

test("a recorded drive is known as if it had been watched", () => {
  const drive = played();
  assert.equal(drive.enhanced.count, 101);
  assert.equal(drive.state?.state, State.tracking);
  assert.equal(drive.corrections.length, 1);
  assert.equal(drive.places.all.get(7)?.corrections, 1);
  assert.equal(drive.yawOfFrame.get(panoramaFrame), 0.5);
  assert.equal(drive.integrity?.horizontal_protection_level_m, 1);
  near(drive.driven_m, 10 * Math.hypot(1, 0.1), 1e-6);
  near(drive.error_m, 0, 1e-6);
  near(drive.drift_m, 1, 1e-6);
  assert.ok(drive.entries.some(({ text, detail }) => text === "Place 7 recognised" && detail.includes("0.80 m")));
  assert.ok(drive.entries.some(({ text, detail }) => text === "Stereo cameras see too little" && detail === "a bus"));
});

test("its error is that of each time", () => {
  const { series } = played();
  const at = (time: number) => series.error.values[series.error.times.findIndex((one) => one >= time - 1e-6)]!;
  near(at(5), 0.5, 1e-6);
  near(at(9), 0, 1e-6);
});

test("the compass is compared with the odometry, also if its panoramas have other stamps", () => {
  const drive = new Drive();
  const turning = recordedStreet();
  turning.binocular = turning.binocular.map(([time, x, y]) => [time, x, y, 0.1 * time]);
  turning.azimuth = [[2.02, 1.02, 0.1]];
  playInto(drive, turning);
  near(drive.series.odometry.last!, (0.1 * 180) / Math.PI, 1e-6);
  near(drive.series.compass.last!, (0.1 * 180) / Math.PI, 1e-6);
});

test("the moment of the cursor has its own pose and the place recognised last", () => {
  const drive = played();
  const early = momentOf(drive, 4.05);
  near(early.pose!.x, 4, 1e-6);
  assert.equal(early.recognised, undefined);
  const late = momentOf(drive, 9.5);
  near(late.pose!.x, 9.5, 1e-6);
  assert.equal(late.recognised?.place, 7);
  near(late.recognised!.heading, -Math.PI / 2, 1e-9);
});

test("the head of the page is that of the cursor's time", () => {
  const heads = playInto(new Drive(), recordedStreet());
  assert.equal(heads.at(6)?.state?.reason, "a bus");
  near(heads.at(5)!.error_m, 0.5, 1e-6);
  near(heads.at(5)!.driven_m, 5 * Math.hypot(1, 0.1), 1e-6);
  near(heads.at(5)!.now - heads.at(5)!.begin, 5, 1e-6);
  assert.equal(heads.at(-1), heads.at(0));
  near(heads.at()!.error_m, 0, 1e-6);
});
