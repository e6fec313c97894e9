// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { linesBetween, shownIn } from "../../src/cameras/match_lines.ts";
import { matchesOf } from "../../src/model/matches.ts";
import type { PointCloud } from "../../src/model/point_cloud.ts";
import { matchCloud, near, pointCloud } from "./make.ts";

test("matched points are read by the names of their fields", () => {
  const cloud = matchCloud(12.5, 7, [{ u: 0.25, v: 0.5, place_u: 0.75, place_v: 0.625, state: 1 }, { u: 0, v: 0, place_u: 0, place_v: 0, state: 2 }]);
  const matches = matchesOf(cloud)!;
  near(matches.time, 12.5);
  assert.equal(matches.place, 7);
  assert.deepEqual(matches.points[0], { u: 0.25, v: 0.5, placeU: 0.75, placeV: 0.625, agrees: true });
  assert.equal(matches.points[1]!.agrees, false);
});

test("a cloud that lacks a field, is empty or is truncated gives no matches", () => {
  assert.equal(matchesOf(pointCloud(1, [{ u: 1, v: 1, track: 1, state: 1 }]) as PointCloud), undefined);
  assert.equal(matchesOf(matchCloud(1, 7, [])), undefined);
  const cut = matchCloud(1, 7, [1, 1].map((state) => ({ u: 0, v: 0, place_u: 0, place_v: 0, state })));
  assert.equal(matchesOf({ ...cut, data: cut.data.slice(0, 40) })!.points.length, 1);
});

const panorama = shownIn({ left: 0, top: 0, width: 400, height: 138 }, 2); // 200 px high, of which 138 are seen
const place = shownIn({ left: 0, top: 160, width: 400, height: 118 }, 2);
const point = { u: 0.5, v: 0.55, placeU: 0.25, placeV: 0.55, agrees: true };

test("the same point of both pictures is joined straight down once the place is turned", () => {
  const [line] = linesBetween([point], panorama, place, 0.25);
  near(line!.x1, 200);
  near(line!.x2, 200);
  near(line!.y1, 0.55 * 138);
  near(line!.y2, 160 + 0.55 * 118);
});

test("what is turned out at the right comes in at the left", () => {
  near(linesBetween([point], panorama, place, 0.85)[0]!.x2, 40);
});

test("points that are cut off in one of the pictures have no line; those that agree lie on top", () => {
  const lines = linesBetween([point, { ...point, agrees: false }, { ...point, v: 0.05 }, { ...point, placeV: 0.99 }], panorama, place, 0);
  assert.deepEqual(lines.map(({ agrees }) => agrees), [false, true]);
});
