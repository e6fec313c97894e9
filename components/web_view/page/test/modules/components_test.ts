// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { componentsOf, droppedBy } from "../../src/model/components.ts";
import { nodeOf, rangeText, readValue } from "../../src/panels/parameter_values.ts";
import { header } from "./make.ts";

test("the diagnostics of a component are parsed", () => {
  const values = [
    { key: "/panorama/image rate", value: "5.0 Hz" },
    { key: "/panorama/image latency", value: "median 0.05 ms, p95 1.25 ms, max 9.00 ms" },
    { key: "/panorama/image messages", value: "40 received, 38 handled, 2 dropped, 0 waiting, 0 undecodable" },
    { key: "track time", value: "mean 4.50 ms, p95 7.00 ms, max 20.00 ms, CPU mean 4.40 ms" },
    { key: "CPU", value: "12.5 %" },
    { key: "restarted", value: "1 times, after an error" },
  ];
  const [compass] = componentsOf({ header: header(0), status: [{ level: 1, name: "panvo: panoramic_compass", message: "too slow", values }] });
  assert.deepEqual(compass, {
    name: "panoramic_compass",
    level: 1,
    message: "too slow",
    inputs: [{ topic: "/panorama/image", rate_hz: 5, latency_ms: 1.25, dropped: 2 }],
    stages: [{ name: "track", mean_ms: 4.5, p95_ms: 7 }],
    cpu_percent: 12.5,
    other: [{ key: "restarted", value: "1 times, after an error" }],
  });
  assert.equal(droppedBy(compass!), 2);
});

test("the name of a parameter has a node and a rest", () => {
  assert.deepEqual(nodeOf("/panvo/localizer/integrity.risk"), { node: "/panvo/localizer", parameter: "integrity.risk" });
  assert.deepEqual(nodeOf("/localizer/qos_overrides./tf.publisher.depth"), { node: "/localizer", parameter: "qos_overrides./tf.publisher.depth" });
  assert.deepEqual(nodeOf("rate"), { node: "", parameter: "rate" });
});

test("typed values keep the type", () => {
  assert.equal(readValue("2.5", 1), 2.5);
  assert.equal(readValue("two", 1), undefined);
  assert.equal(readValue("", 1), undefined);
  assert.equal(readValue("2.5", "text"), "2.5");
  assert.deepEqual(readValue("[1, 2]", [0]), [1, 2]);
  assert.equal(readValue("{}", [0]), undefined);
});

test("a range is described in words", () => {
  const range = { description: "gate", read_only: false, floating_point_range: [{ from_value: 0, to_value: 100 }], integer_range: [] };
  assert.equal(rangeText(range), "gate; 0 to 100");
});
