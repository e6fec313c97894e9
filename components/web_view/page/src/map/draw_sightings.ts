// SPDX-License-Identifier: Apache-2.0
/** The edges of the graph, which are sightings of places, and the corrections that they led to. */
import type { Drive } from "../model/drive.ts";
import { outcomeText, type Correction } from "../model/happenings.ts";
import { Outcome } from "../model/messages.ts";
import type { Colours } from "../ui/colours.ts";
import { haloText } from "./draw_ground.ts";
import type { View } from "./view.ts";

const pulse_s = 1.5;
const fresh_s = 4; // how long what has just happened is named
const pieces = 100; // lines in one stroke; the time of a stroke grows faster than the number of its lines

interface Style {
  outcome: number;
  colour: keyof Colours;
  dash: number[];
}

/** Told apart by dashes too. Those that were used lie on top. */
const styles: Style[] = [
  { outcome: Outcome.rejected, colour: "caution", dash: [6, 4] },
  { outcome: Outcome.betterKnown, colour: "soft", dash: [2, 4] },
  { outcome: Outcome.applied, colour: "good", dash: [] },
];

interface Ends {
  x1: number;
  y1: number;
  x2: number;
  y2: number;
}

/** From the place to where the vehicle was when it saw the place; undefined if that is not in view or too short to be seen. */
function endsOf({ place, after }: Correction, drive: Drive, view: View): Ends | undefined {
  const seen = drive.places.all.get(place);
  if (!seen) return undefined;
  const from = view.toScreen(seen.pose.x, seen.pose.y);
  const to = view.toScreen(after.x, after.y);
  const isOutside = Math.max(from.x, to.x) < 0 || Math.min(from.x, to.x) > view.width || Math.max(from.y, to.y) < 0 || Math.min(from.y, to.y) > view.height;
  if (isOutside || Math.abs(from.x - to.x) + Math.abs(from.y - to.y) < 2) return undefined;
  return { x1: from.x, y1: from.y, x2: to.x, y2: to.y };
}

export function drawSightings(context: CanvasRenderingContext2D, drive: Drive, view: View, colours: Colours): void {
  context.lineWidth = 1.25;
  context.lineCap = "butt";
  for (const { outcome, colour, dash } of styles) {
    context.setLineDash(dash);
    context.strokeStyle = colours[colour];
    let count = 0;
    context.beginPath();
    for (const correction of drive.corrections) {
      const ends = correction.outcome === outcome ? endsOf(correction, drive, view) : undefined;
      if (!ends) continue;
      context.moveTo(ends.x1, ends.y1);
      context.lineTo(ends.x2, ends.y2);
      if (++count % pieces > 0) continue;
      context.stroke();
      context.beginPath();
    }
    context.stroke();
  }
  context.setLineDash([]);
}

/** Corrections, from the estimated to the corrected position. Rejected ones are crosses. */
export function drawCorrections(context: CanvasRenderingContext2D, drive: Drive, view: View, colours: Colours): void {
  context.lineWidth = 2.5;
  context.lineCap = "round";
  for (const { outcome, before, after } of drive.corrections) {
    if (outcome === Outcome.betterKnown) continue;
    const from = view.toScreen(before.x, before.y);
    const to = view.toScreen(after.x, after.y);
    if (to.x < -200 || to.y < -200 || to.x > view.width + 200 || to.y > view.height + 200) continue;
    context.beginPath();
    if (outcome === Outcome.applied) {
      context.strokeStyle = context.fillStyle = colours.good;
      context.moveTo(from.x, from.y);
      context.lineTo(to.x, to.y);
      context.moveTo(to.x + 3.5, to.y);
      context.arc(to.x, to.y, 3.5, 0, 2 * Math.PI);
      context.fill();
    } else {
      context.strokeStyle = colours.caution;
      context.moveTo(from.x - 4, from.y - 4);
      context.lineTo(from.x + 4, from.y + 4);
      context.moveTo(from.x - 4, from.y + 4);
      context.lineTo(from.x + 4, from.y - 4);
    }
    context.stroke();
  }
}

/** The newest sighting, if it has just happened; one that was used rather than a later one that was not. */
export function freshSighting(drive: Drive): Correction | undefined {
  const fresh = drive.corrections.slice(-10).filter(({ time }) => drive.now - time >= 0 && drive.now - time < fresh_s);
  return fresh.filter(({ outcome }) => outcome === Outcome.applied).at(-1) ?? fresh.at(-1);
}

/** What has just happened: its edge in bold, rings that grow and fade around the corrected position, and its name in words. */
export function drawFresh(context: CanvasRenderingContext2D, drive: Drive, view: View, colours: Colours): void {
  const fresh = freshSighting(drive);
  if (!fresh) return;
  const { colour, dash } = styles.find(({ outcome }) => outcome === fresh.outcome) ?? styles[0]!;
  context.strokeStyle = colours[colour];
  context.lineWidth = 3;
  const ends = endsOf(fresh, drive, view);
  if (ends) {
    context.setLineDash(dash);
    context.beginPath();
    context.moveTo(ends.x1, ends.y1);
    context.lineTo(ends.x2, ends.y2);
    context.stroke();
    context.setLineDash([]);
  }
  const { x, y } = view.toScreen(fresh.after.x, fresh.after.y);
  const part = (drive.now - fresh.time) / pulse_s;
  if (part <= 1 && fresh.outcome === Outcome.applied) {
    context.globalAlpha = 1 - part;
    context.beginPath();
    context.arc(x, y, 6 + 18 * part, 0, 2 * Math.PI);
    context.stroke();
    context.globalAlpha = 1;
  }
  const isAtRight = x > view.width * 0.6;
  haloText(context, `Place ${fresh.place}: ${outcomeText(fresh)}`, x + (isAtRight ? -22 : 22), y + 26, colours, isAtRight ? "right" : "left", colours[colour]);
}
