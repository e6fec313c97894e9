// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { trace } from "../../src/map/trace.ts";
import { View } from "../../src/map/view.ts";
import { mapFromFrame } from "../../src/model/anchor.ts";
import { composed } from "../../src/model/geometry.ts";
import { Odometer } from "../../src/model/odometer.ts";
import { Path } from "../../src/model/path.ts";
import { near } from "./make.ts";

function straight(poses: number, step = 1): Path {
  const path = new Path();
  for (let i = 0; i < poses; ++i) path.add(i / 10, { x: i * step, y: 0, yaw: 0 });
  return path;
}

class Pen {
  moves: [number, number][] = [];
  lines: [number, number][] = [];
  moveTo(x: number, y: number): void {
    this.moves.push([x, y]);
  }
  lineTo(x: number, y: number): void {
    this.lines.push([x, y]);
  }
}

test("the pose at a time is the last one that is not after it", () => {
  const path = straight(5000);
  assert.equal(path.indexAt(-1), -1);
  assert.equal(path.indexAt(0), 0);
  assert.equal(path.indexAt(100.05), 1000);
  assert.equal(path.indexAt(1e9), 4999);
  assert.equal(path.exactly(100.0004)!.x, 1000);
  assert.equal(path.exactly(100.05), undefined);
});

test("a full path keeps its extent and counts what it received", () => {
  const path = new Path(1000);
  for (let i = 0; i < 3000; ++i) path.add(i, { x: i, y: -i, yaw: 0 });
  assert.ok(path.count <= 1000);
  assert.equal(path.received, 3000);
  assert.deepEqual(path.bounds(), { left: 0, right: 2999, bottom: -2999, top: -0 });
  for (let i = 1; i < path.count; ++i) assert.ok(path.times[i]! > path.times[i - 1]!);
});

test("a long path is drawn with no more points than the screen can show, up to its end", () => {
  const view = Object.assign(new View(), { width: 800, height: 600 });
  const path = straight(100_000, 0.05);
  view.fit(path.bounds());
  const pen = new Pen();
  assert.ok(trace(pen, path, view) < 600);
  const [x, y] = pen.lines[pen.lines.length - 1]!;
  const end = view.toScreen(99_999 * 0.05, 0);
  near(x, end.x, 1e-6);
  near(y, end.y, 1e-6);
});

test("parts outside the view are not drawn", () => {
  const view = Object.assign(new View(), { width: 800, height: 600, x: 0, y: 1e6 });
  assert.equal(trace(new Pen(), straight(10_000), view), 0);
});

test("a path in another frame is drawn where that frame lies", () => {
  const view = Object.assign(new View(), { width: 800, height: 600, px_per_m: 10 });
  const mapFromOwn = { x: 5, y: -3, yaw: 0.7 };
  const pen = new Pen();
  trace(pen, straight(20), view, mapFromOwn);
  const { x, y } = composed(mapFromOwn, { x: 19, y: 0, yaw: 0 });
  const end = view.toScreen(x, y);
  near(pen.lines[pen.lines.length - 1]![0], end.x, 1e-6);
  near(pen.lines[pen.lines.length - 1]![1], end.y, 1e-6);
});

test("a frame is aligned at the first common stamp", () => {
  const mapFromOwn = { x: 10, y: 20, yaw: 1 };
  const own = straight(50);
  const reference = new Path();
  for (let i = 7; i < 50; ++i) reference.add(i / 10, composed(mapFromOwn, own.at(i)));
  const found = mapFromFrame(reference, own, -Infinity)!;
  near(found.x, 10);
  near(found.y, 20);
  near(found.yaw, 1);
  assert.equal(mapFromFrame(reference, new Path(), -Infinity), undefined);
});

test("the way driven does not grow while the vehicle stands", () => {
  const odometer = new Odometer();
  for (let i = 0; i <= 100; ++i) odometer.add({ x: i / 10, y: 0, yaw: 0 });
  for (let i = 0; i < 1000; ++i) odometer.add({ x: 10 + (i % 2) * 0.01, y: 0, yaw: 0 });
  near(odometer.length_m, 10, 0.11);
});
