// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { SceneCache } from "../../src/map/scene_cache.ts";
import { View } from "../../src/map/view.ts";
import { Drive } from "../../src/model/drive.ts";
import { odometry } from "./make.ts";

/** What is used of a canvas; counts the lines. */
class Canvas {
  lines = 0;
  width = 0;
  height = 0;
  getContext = () => this;
  setTransform(): void {}
  clearRect(): void {}
  beginPath(): void {}
  moveTo(): void {}
  stroke(): void {}
  drawImage(): void {}
  lineTo(): void {
    ++this.lines;
  }
}

const layers = { enhanced: true, binocular: true, truth: true, places: false, sightings: false, corrections: false, uncertainty: false };
const view = Object.assign(new View(), { width: 800, height: 600, x: 20, y: 0, px_per_m: 8 });

/** A map whose clock stands still; `draw` returns the lines drawn into the picture that is kept, and those drawn on top of it. */
function mapOf(drive: Drive) {
  const [picture, screen] = [new Canvas(), new Canvas()];
  Object.assign(globalThis, { devicePixelRatio: 1, document: { createElement: () => picture } });
  const cache = new SceneCache();
  return () => {
    picture.lines = screen.lines = 0;
    cache.draw(screen as never, drive, layers, view, {} as never, 1e6);
    return { kept: picture.lines, onTop: screen.lines };
  };
}

function drives(drive: Drive, along: "x" | "y", poses: number): void {
  for (let i = 0; i < poses; ++i)
    drive.take({ role: "binocular", topic: "", message: odometry(100 + i * 0.1, { x: 0, y: 0, yaw: 0, [along]: i * 0.2 }) });
}

test("poses that come are drawn on top of the picture that is kept", () => {
  const drive = new Drive();
  const draw = mapOf(drive);
  drives(drive, "x", 300);
  assert.deepEqual(draw(), { kept: 299, onTop: 0 });
  assert.deepEqual(draw(), { kept: 0, onTop: 0 });
  drive.take({ role: "binocular", topic: "", message: odometry(130, { x: 60, y: 0, yaw: 0 }) });
  assert.deepEqual(draw(), { kept: 0, onTop: 1 });
});

test("a bag of stereo images alone that starts again leaves nothing of the drive before", () => {
  const drive = new Drive();
  const draw = mapOf(drive);
  drives(drive, "x", 300);
  draw();
  drives(drive, "y", 100);
  assert.equal(drive.binocular.count, 100);
  assert.deepEqual(draw(), { kept: 99, onTop: 0 });
  drives(drive, "y", 100);
  assert.deepEqual(draw(), { kept: 99, onTop: 0 });
});
