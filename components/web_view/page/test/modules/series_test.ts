// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { Rate } from "../../src/model/rates.ts";
import { Series, thinned } from "../../src/model/series.ts";
import { nearestValue } from "../../src/timeline/values.ts";
import { near } from "./make.ts";

test("a thinned curve keeps its peak", () => {
  for (let peak = 5000; peak < 5050; ++peak) {
    const series = new Series();
    for (let i = 0; i < 10_000; ++i) series.add(i, i === peak ? 100 : 1);
    const { times, values } = thinned(series, 0, 10_000, 300);
    assert.ok(values.length <= 301);
    assert.equal(values[times.indexOf(peak)], 100);
  }
});

test("only the window is returned, with a neighbour on each side", () => {
  const series = new Series();
  for (let i = 0; i < 100; ++i) series.add(i, i);
  assert.deepEqual(thinned(series, 10, 12, 100).times, [9, 10, 11, 12]);
});

test("a series stays bounded, and NaN values are gaps", () => {
  const series = new Series(100);
  for (let i = 0; i < 1000; ++i) series.add(i, i);
  assert.ok(series.times.length <= 100);
  series.add(1000, NaN);
  assert.equal(series.last, null);
});

test("a value is read at its time, but not long after", () => {
  const series = new Series();
  series.add(10, 1);
  series.add(11, 2);
  assert.equal(nearestValue(series, 9), null);
  assert.equal(nearestValue(series, 10.5), 1);
  assert.equal(nearestValue(series, 11), 2);
  assert.equal(nearestValue(series, 60), null);
});

test("the rate is that of the last two seconds", () => {
  const rate = new Rate();
  assert.equal(rate.add(0), undefined);
  let last: number | undefined;
  for (let i = 1; i <= 100; ++i) last = rate.add(i * 0.04);
  near(last!, 25, 1e-6);
});
