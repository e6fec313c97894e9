// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { composed, ellipseOf, flat, inverse, wrapped } from "../../src/model/geometry.ts";
import { covariance, near, pose } from "./make.ts";

test("a pose times its inverse is the identity", () => {
  const a = { x: 3, y: -2, yaw: 2.5 };
  const { x, y, yaw } = composed(a, inverse(a));
  near(x, 0);
  near(y, 0);
  near(yaw, 0);
});

test("a pose ahead of one that looks to the left lies to the left", () => {
  const { x, y } = composed({ x: 1, y: 1, yaw: Math.PI / 2 }, { x: 2, y: 0, yaw: 0 });
  near(x, 1);
  near(y, 3);
});

test("the yaw of a quaternion is read back", () => {
  for (const yaw of [-3, -1, 0, 0.5, 3]) near(flat(pose({ x: 0, y: 0, yaw })).yaw, yaw);
});

test("angles are wrapped to half a turn", () => {
  near(wrapped(3 * Math.PI), -Math.PI);
  near(wrapped(-0.1), -0.1);
  near(wrapped(2 * Math.PI + 0.2), 0.2);
});

test("the ellipse of a turned covariance has its axes and direction", () => {
  // Variances 4 and 1, turned by 30 degrees.
  const c = Math.cos(Math.PI / 6);
  const s = Math.sin(Math.PI / 6);
  const ellipse = ellipseOf(covariance(4 * c * c + s * s, 3 * c * s, 4 * s * s + c * c))!;
  near(ellipse.major, 2);
  near(ellipse.minor, 1);
  near(ellipse.angle, Math.PI / 6);
});

test("an invalid covariance has no ellipse", () => {
  assert.equal(ellipseOf(covariance(-1, 0, 1)), undefined);
  assert.equal(ellipseOf(covariance(NaN, 0, 1)), undefined);
  assert.equal(ellipseOf([]), undefined);
});
