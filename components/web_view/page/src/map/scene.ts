// SPDX-License-Identifier: Apache-2.0
/** What stands still on the map: paths, places, sightings and corrections. */
import type { Drive } from "../model/drive.ts";
import { identity, type Pose2 } from "../model/geometry.ts";
import type { Path } from "../model/path.ts";
import type { Colours } from "../ui/colours.ts";
import { drawPlaces } from "./draw_places.ts";
import { drawCorrections, drawSightings } from "./draw_sightings.ts";
import { Pieces } from "./pieces.ts";
import { trace } from "./trace.ts";
import type { View } from "./view.ts";

export interface Layers {
  enhanced: boolean;
  binocular: boolean;
  truth: boolean;
  places: boolean;
  sightings: boolean;
  corrections: boolean;
  uncertainty: boolean;
}

export interface Line {
  path: Path;
  mapFromOwn: Pose2;
  colour: keyof Colours;
  width: number;
}

/** The paths that are shown, those below first. */
export function linesOf(drive: Drive, layers: Layers): Line[] {
  const lines: Line[] = [];
  const mapFromOdom = drive.enhanced.count === 0 ? identity : drive.mapFromOdom;
  if (layers.truth && drive.mapFromTruth) lines.push({ path: drive.truth, mapFromOwn: drive.mapFromTruth, colour: "truth", width: 6 });
  if (layers.binocular && mapFromOdom) lines.push({ path: drive.binocular, mapFromOwn: mapFromOdom, colour: "binocular", width: 1.75 });
  if (layers.enhanced) lines.push({ path: drive.enhanced, mapFromOwn: identity, colour: "enhanced", width: 2.75 });
  return lines;
}

export function drawLine(context: CanvasRenderingContext2D, line: Line, view: View, colours: Colours, from = 0): void {
  context.lineWidth = line.width;
  context.lineJoin = context.lineCap = "round";
  context.strokeStyle = colours[line.colour];
  const pen = new Pieces(context);
  trace(pen, line.path, view, line.mapFromOwn, from);
  pen.end();
}

export function drawScene(context: CanvasRenderingContext2D, drive: Drive, layers: Layers, view: View, colours: Colours): void {
  for (const line of linesOf(drive, layers)) drawLine(context, line, view, colours);
  if (layers.sightings) drawSightings(context, drive, view, colours);
  if (layers.places) drawPlaces(context, drive, view, colours);
  if (layers.corrections) drawCorrections(context, drive, view, colours);
}
