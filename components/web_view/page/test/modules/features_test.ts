// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { WaitingImages, type ImageHappening } from "../../src/cameras/waiting_images.ts";
import { FeatureTrails, featuresOf } from "../../src/model/features.ts";
import type { PointCloud } from "../../src/model/point_cloud.ts";
import { near, pointCloud } from "./make.ts";

test("the points of a cloud, wherever it lies in its buffer", () => {
  const cloud = pointCloud(12.5, [{ u: 100.5, v: 20, track: 4_000_000_000, state: 2 }, { u: 1, v: 2, track: 1, state: 0 }]);
  const padded = new Uint8Array(cloud.data.length + 3);
  padded.set(cloud.data, 3);
  const { time, points } = featuresOf({ ...cloud, data: padded.subarray(3) })!;
  near(time, 12.5);
  assert.deepEqual(points, [{ u: 100.5, v: 20, track: 4_000_000_000, state: 2 }, { u: 1, v: 2, track: 1, state: 0 }]);
});

test("a cloud of another sensor has none, and a cut one has fewer", () => {
  const cloud: PointCloud = pointCloud(1, [{ u: 1, v: 2, track: 1, state: 0 }, { u: 3, v: 4, track: 2, state: 0 }]);
  assert.equal(featuresOf({ ...cloud, fields: cloud.fields.filter(({ name }) => name !== "u") }), undefined);
  assert.equal(featuresOf({ ...cloud, data: cloud.data.subarray(0, 30) })!.points.length, 1);
});

test("trails are of one point, newest first, and end where it was not seen", () => {
  const trails = new FeatureTrails(3);
  const at = (time: number, ...points: [track: number, u: number][]) => trails.add({ time, points: points.map(([track, u]) => ({ track, u, v: 0, state: 1 })) });
  at(1, [7, 10]);
  at(2, [7, 11], [8, 50]);
  at(3, [8, 51]);
  at(4, [7, 13], [8, 52]);
  at(5, [8, 53]);
  assert.deepEqual(trails.at(4)!.map(({ way }) => way.map(({ u }) => u)), [[13], [52, 51, 50]]);
  assert.deepEqual(trails.at(5)!.map(({ way }) => way.map(({ u }) => u)), [[53, 52, 51]]);
  assert.equal(trails.at(4.5), undefined);
});

test("a recording that starts again forgets the trails", () => {
  const trails = new FeatureTrails();
  trails.add({ time: 5, points: [] });
  trails.add({ time: 1, points: [] });
  assert.equal(trails.at(5), undefined);
  assert.deepEqual(trails.at(1), []);
});

test("an image waits for its points, but not for ever", () => {
  const waiting = new WaitingImages();
  const closed: number[] = [];
  const imageAt = (stamp_s: number): ImageHappening => ({ kind: "image", topic: "left", frame: "left", stamp_s, bitmap: { close: () => closed.push(stamp_s) } as unknown as ImageBitmap });
  const shown = (stamp_s: number, newest: number) => waiting.add(imageAt(stamp_s), { newest })?.stamp_s;
  assert.equal(shown(1, -Infinity), 1); // without odometry, images do not wait
  assert.equal(shown(2, 2), 2); // its points are there
  assert.equal(shown(2.25, 2), undefined);
  assert.equal(shown(2.5, 2), undefined);
  assert.equal(waiting.take(2), undefined);
  assert.equal(waiting.take(2.5)?.stamp_s, 2.5); // the newest one
  assert.deepEqual(closed, [2.25]);
  for (const stamp_s of [3, 3.125, 3.25, 3.375, 3.5]) assert.equal(shown(stamp_s, 2.75), undefined);
  assert.equal(shown(3.625, 2.75), 3); // points come later than the images of a fifth of a second
  assert.equal(shown(4, 2.75), 4); // no points for more than a second
  assert.equal(waiting.take(9), undefined);
});
