// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { drawSightings, freshSighting } from "../../src/map/draw_sightings.ts";
import { Pieces } from "../../src/map/pieces.ts";
import { View } from "../../src/map/view.ts";
import { Drive } from "../../src/model/drive.ts";
import { outcomeText } from "../../src/model/happenings.ts";
import { Outcome } from "../../src/model/messages.ts";
import { header, odometry, pose } from "./make.ts";

const colours = { good: "green", caution: "orange", soft: "grey" } as never;
const view = Object.assign(new View(), { width: 400, height: 400, px_per_m: 10 });

function driveWith(outcomes: [number, { x: number; y: number }][]): Drive {
  const drive = new Drive();
  drive.take({ role: "landmarkPoses", topic: "", message: { ids: [7], poses: [{ pose: pose({ x: 0, y: 0, yaw: 0 }), covariance: [] }] } });
  outcomes.forEach(([outcome, { x, y }], i) => {
    const message = { header: header(100 + i), landmark_id: 7, outcome, reason: "far off", before: pose({ x, y: y - 0.5, yaw: 0 }), after: pose({ x, y, yaw: 0 }) };
    drive.take({ role: "outcome", topic: "", message });
  });
  drive.take({ role: "enhanced", topic: "", message: odometry(102, { x: 0, y: 0, yaw: 0 }) });
  return drive;
}

/** What was stroked: colour, dashes, and the lines. */
function strokes(draw: (context: CanvasRenderingContext2D) => void) {
  const done: { colour: string; dash: number[]; lines: number[][] }[] = [];
  let lines: number[][] = [];
  let from: number[] = [];
  const context = {
    strokeStyle: "",
    dash: [] as number[],
    setLineDash: (dash: number[]) => void (context.dash = dash),
    beginPath: () => void (lines = []),
    moveTo: (x: number, y: number) => void (from = [x, y]),
    lineTo: (x: number, y: number) => void lines.push([...from, x, y]),
    stroke: () => void (lines.length > 0 && done.push({ colour: context.strokeStyle, dash: context.dash, lines })),
  };
  draw(context as never);
  return done;
}

test("a sighting is an edge from the place to the vehicle, told apart by colour and by dashes", () => {
  const drive = driveWith([[Outcome.applied, { x: 10, y: 0 }], [Outcome.betterKnown, { x: 0, y: 10 }], [Outcome.rejected, { x: -10, y: 0 }]]);
  assert.deepEqual(strokes((context) => drawSightings(context, drive, view, colours)), [
    { colour: "orange", dash: [6, 4], lines: [[200, 200, 100, 200]] },
    { colour: "grey", dash: [2, 4], lines: [[200, 200, 200, 100]] },
    { colour: "green", dash: [], lines: [[200, 200, 300, 200]] },
  ]);
});

test("edges out of view and of unknown places are left out", () => {
  const drive = driveWith([[Outcome.applied, { x: 10, y: 0 }]]);
  const away = Object.assign(new View(), view, { x: 1000 });
  assert.deepEqual(strokes((context) => drawSightings(context, drive, away, colours)), []);
  drive.places.all.clear();
  assert.deepEqual(strokes((context) => drawSightings(context, drive, view, colours)), []);
});

test("what has just happened is named, the correction rather than what was not used", () => {
  const drive = driveWith([[Outcome.applied, { x: 10, y: 0 }], [Outcome.rejected, { x: 1, y: 0 }]]);
  assert.equal(outcomeText(freshSighting(drive)!), "corrected by 0.50 m");
  assert.equal(outcomeText(drive.corrections[1]!), "not used: far off");
  drive.take({ role: "enhanced", topic: "", message: odometry(110, { x: 0, y: 0, yaw: 0 }) });
  assert.equal(freshSighting(drive), undefined);
});

test("the number of corrections that are kept is limited, and each new one is noticed", () => {
  const drive = driveWith(Array.from({ length: 5010 }, () => [Outcome.betterKnown, { x: 1, y: 0 }]));
  assert.deepEqual([drive.corrections.length, drive.correctionsTaken], [5000, 5010]);
});

test("a line stroked in pieces has the points of the whole line", () => {
  const done = strokes((context) => {
    const pieces = new Pieces(context, 4);
    pieces.moveTo(0, 0);
    for (let x = 1; x <= 10; ++x) pieces.lineTo(x, x);
    pieces.end();
  });
  assert.deepEqual(done.map(({ lines }) => lines.map(([, , x]) => x)), [[1, 2, 3, 4], [5, 6, 7, 8], [9, 10]]);
  assert.deepEqual(done[1]!.lines[0]!.slice(0, 2), [4, 4]);
});
