// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { Declutter } from "../../src/map/declutter.ts";
import { lengthText, roundLength } from "../../src/map/scale.ts";
import { View } from "../../src/map/view.ts";
import { near } from "./make.ts";

const made = () => Object.assign(new View(), { width: 800, height: 600, x: 4, y: -7, px_per_m: 11 });

test("screen and map are inverse to each other, up is north", () => {
  const view = made();
  const { x, y } = view.toMap(123, 45);
  const back = view.toScreen(x, y);
  near(back.x, 123);
  near(back.y, 45);
  assert.ok(view.toScreen(0, 1).y < view.toScreen(0, 0).y);
});

test("zooming keeps what is under the pointer", () => {
  const view = made();
  const before = view.toMap(700, 100);
  view.zoom(3, 700, 100);
  const after = view.toMap(700, 100);
  near(after.x, before.x);
  near(after.y, before.y);
  near(view.px_per_m, 33);
});

test("the fitted bounds are visible beside the covered part", () => {
  const view = made();
  view.fit({ left: -100, right: 300, bottom: 0, top: 50 }, 200);
  const left = view.toScreen(-100, 0).x;
  const right = view.toScreen(300, 0).x;
  assert.ok(left > 200 && right < 800, `${left} to ${right}`);
});

test("nothing to fit changes nothing", () => {
  const view = made();
  view.fit({ left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity });
  assert.equal(view.px_per_m, 11);
});

test("lengths of the scale are 1, 2 or 5 times a power of ten", () => {
  assert.deepEqual([0.3, 1, 1.99, 7, 49, 50, 1200].map(roundLength).map((value) => Number(value.toFixed(6))), [0.2, 1, 1, 5, 20, 50, 1000]);
  assert.deepEqual([0.2, 5, 2000].map(lengthText), ["20 cm", "5 m", "2 km"]);
});

test("only one of overlapping marks is drawn", () => {
  const declutter = new Declutter(5);
  assert.ok(declutter.takes(100, 100));
  assert.ok(!declutter.takes(101, 101));
  assert.ok(declutter.takes(110, 100));
});
