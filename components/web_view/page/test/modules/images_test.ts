// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { columnOf, shiftOf, sidesOf } from "../../src/cameras/heading_tape.ts";
import { toRgba, type RawImage } from "../../src/link/pixels.ts";
import { preferredImage, roleOf } from "../../src/link/roles.ts";
import { near } from "./make.ts";

const image = (encoding: string, width: number, height: number, step: number, data: number[]): RawImage => ({ encoding, width, height, step, is_bigendian: 0, data: new Uint8Array(data) });

test("pixels of each encoding, with padded rows", () => {
  assert.deepEqual([...toRgba(image("bgr8", 1, 2, 4, [1, 2, 3, 99, 4, 5, 6]))], [3, 2, 1, 255, 6, 5, 4, 255]);
  assert.deepEqual([...toRgba(image("rgb8", 1, 1, 3, [1, 2, 3]))], [1, 2, 3, 255]);
  assert.deepEqual([...toRgba(image("mono8", 2, 1, 2, [7, 8]))], [7, 7, 7, 255, 8, 8, 8, 255]);
  assert.deepEqual([...toRgba(image("mono16", 1, 1, 2, [0x34, 0x12]))], [0x12, 0x12, 0x12, 255]);
  assert.deepEqual([...toRgba({ ...image("mono16", 1, 1, 2, [0x12, 0x34]), is_bigendian: 1 })], [0x12, 0x12, 0x12, 255]);
  assert.deepEqual([...toRgba(image("bgra8", 1, 1, 4, [1, 2, 3, 0]))], [3, 2, 1, 255]);
});

test("images that cannot be shown are errors", () => {
  assert.throws(() => toRgba(image("bayer_rggb8", 1, 1, 1, [0])), /bayer_rggb8/);
  assert.throws(() => toRgba(image("bgr8", 2, 2, 6, [0, 0, 0])), /fewer bytes/);
  assert.throws(() => toRgba(image("mono8", 4, 1, 2, [0, 0])), /fewer bytes/);
});

test("directions in the panorama: left is left of the middle", () => {
  near(columnOf(0, 0), 0.5);
  near(columnOf(Math.PI / 2, 0), 0.25);
  near(columnOf(0, Math.PI / 2), 0.75);
  const sides = sidesOf(1, 1);
  near(sides.find(({ text }) => text === "ahead")!.at, 0.5);
  near(sides.find(({ text }) => text === "right")!.at, 0.75);
  near(sides.find(({ text }) => text === "back")!.at, 0);
});

test("the picture of a place is moved so that the same thing stands below itself", () => {
  // Something at azimuth 0.3 of the map, seen from headings 1.2 now and -0.4 then.
  const now = columnOf(0.3, 1.2);
  const then = columnOf(0.3, -0.4);
  near((then + shiftOf(1.2 - -0.4)) % 1, now);
});

test("topics are recognised by name and type, in any namespace", () => {
  assert.equal(roleOf({ topic: "/odometry/enhanced", schemaName: "nav_msgs/msg/Odometry" }), "enhanced");
  assert.equal(roleOf({ topic: "/robot/odometry/enhanced", schemaName: "nav_msgs/msg/Odometry" }), "enhanced");
  assert.equal(roleOf({ topic: "/odometry/enhanced", schemaName: "nav_msgs/msg/Path" }), undefined);
  assert.equal(roleOf({ topic: "/other_odometry/enhanced", schemaName: "nav_msgs/msg/Odometry" }), undefined);
});

test("rectified images are preferred, and beyond this machine compressed ones", () => {
  const topics = ["/stereo/left/image_raw", "/stereo/left/image_raw/compressed", "/stereo/left/image_rect", "/panorama/image"];
  assert.equal(preferredImage(topics, "left", false), "/stereo/left/image_rect");
  const both = [...topics, "/panorama/image/compressed"];
  assert.equal(preferredImage(both, "panorama", false), "/panorama/image/compressed");
  assert.equal(preferredImage(both, "panorama", true), "/panorama/image");
  assert.equal(preferredImage(["/panorama/image/compressed"], "panorama", true), "/panorama/image/compressed");
  assert.equal(preferredImage(["/front"], "left", false), undefined);
  assert.equal(preferredImage(["/panorama/vehicle_mask"], "panorama", true), undefined);
});
