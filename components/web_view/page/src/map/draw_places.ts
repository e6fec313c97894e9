// SPDX-License-Identifier: Apache-2.0
import { Outcome } from "../model/messages.ts";
import type { Drive } from "../model/drive.ts";
import type { Place } from "../model/places.ts";
import type { Colours } from "../ui/colours.ts";
import { Declutter } from "./declutter.ts";
import { haloText } from "./draw_ground.ts";
import type { View } from "./view.ts";

const labels_from_px_per_m = 4;
const pulse_s = 1.5;

function isNear(view: View, x: number, y: number, margin = 20): boolean {
  return x > -margin && y > -margin && x < view.width + margin && y < view.height + margin;
}

/** A disc; a junction is a diamond. */
function mark(context: CanvasRenderingContext2D, place: Place, x: number, y: number, radius: number): void {
  if (place.isJunction) {
    const r = radius * 1.25;
    context.moveTo(x, y - r);
    context.lineTo(x + r, y);
    context.lineTo(x, y + r);
    context.lineTo(x - r, y);
    context.closePath();
  } else {
    context.moveTo(x + radius, y);
    context.arc(x, y, radius, 0, 2 * Math.PI);
  }
}

/** All marks in one stroke, so that thousands take a few milliseconds. */
export function drawPlaces(context: CanvasRenderingContext2D, drive: Drive, view: View, colours: Colours): void {
  const small = view.px_per_m < 2;
  const radius = small ? 3.5 : 5.5;
  const declutter = new Declutter(small ? 5 : 3);
  const labelled: { text: string; x: number; y: number }[] = [];
  const room = new Declutter(44);
  context.beginPath();
  for (const place of drive.places.all.values()) {
    const { x, y } = view.toScreen(place.pose.x, place.pose.y);
    if (!isNear(view, x, y) || !declutter.takes(x, y)) continue;
    mark(context, place, x, y, radius);
    if (view.px_per_m >= labels_from_px_per_m && room.takes(x, y)) labelled.push({ text: String(place.id), x, y });
  }
  context.fillStyle = colours.landmark;
  context.fill();
  context.lineWidth = 1.5;
  context.strokeStyle = colours.card;
  context.stroke();
  for (const { text, x, y } of labelled) haloText(context, text, x + 9, y - 7, colours, "left");
}

/** Rings around the chosen place and the one that is being passed. */
export function drawRings(context: CanvasRenderingContext2D, drive: Drive, view: View, colours: Colours, chosen: number | undefined): void {
  const place = chosen === undefined ? undefined : drive.places.all.get(chosen);
  if (place) ring(context, view, place, colours.ink, 11);
  const locked = drive.recognised && drive.now - drive.recognised.time < 1 ? drive.places.all.get(drive.recognised.place) : undefined;
  if (locked) ring(context, view, locked, colours.good, 15);
}

function ring(context: CanvasRenderingContext2D, view: View, { pose }: Place, colour: string, radius: number): void {
  const { x, y } = view.toScreen(pose.x, pose.y);
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.lineWidth = 2.5;
  context.strokeStyle = colour;
  context.stroke();
}

/** The edges of the graph: from each place to where the vehicle was when it saw that place again. */
export function drawSightings(context: CanvasRenderingContext2D, drive: Drive, view: View, colours: Colours): void {
  context.beginPath();
  for (const { outcome, place, after } of drive.corrections) {
    const seen = drive.places.all.get(place);
    if (!seen || outcome !== Outcome.applied) continue;
    const from = view.toScreen(seen.pose.x, seen.pose.y);
    const to = view.toScreen(after.x, after.y);
    context.moveTo(from.x, from.y);
    context.lineTo(to.x, to.y);
  }
  context.setLineDash([2, 4]);
  context.lineWidth = 1.25;
  context.strokeStyle = colours.soft;
  context.stroke();
  context.setLineDash([]);
}

/** Corrections, from the estimated to the corrected position. Rejected ones are crosses. */
export function drawCorrections(context: CanvasRenderingContext2D, drive: Drive, view: View, colours: Colours): void {
  context.lineWidth = 2.5;
  context.lineCap = "round";
  for (const { outcome, before, after } of drive.corrections) {
    const isApplied = outcome === Outcome.applied;
    if (outcome === Outcome.betterKnown) continue;
    const from = view.toScreen(before.x, before.y);
    const to = view.toScreen(after.x, after.y);
    if (!isNear(view, to.x, to.y, 200)) continue;
    context.strokeStyle = context.fillStyle = isApplied ? colours.good : colours.caution;
    context.beginPath();
    if (isApplied) {
      context.moveTo(from.x, from.y);
      context.lineTo(to.x, to.y);
      context.moveTo(to.x + 3.5, to.y);
      context.arc(to.x, to.y, 3.5, 0, 2 * Math.PI);
      context.fill();
    } else {
      context.moveTo(from.x - 4, from.y - 4);
      context.lineTo(from.x + 4, from.y + 4);
      context.moveTo(from.x - 4, from.y + 4);
      context.lineTo(from.x + 4, from.y - 4);
    }
    context.stroke();
  }
}

/** Rings that grow and fade around corrections that have just happened. */
export function drawPulses(context: CanvasRenderingContext2D, drive: Drive, view: View, colours: Colours): void {
  context.strokeStyle = colours.good;
  context.lineWidth = 2.5;
  for (const { outcome, after, time } of drive.corrections.slice(-10)) {
    const part = (drive.now - time) / pulse_s;
    if (outcome !== Outcome.applied || part < 0 || part > 1) continue;
    const { x, y } = view.toScreen(after.x, after.y);
    context.globalAlpha = 1 - part;
    context.beginPath();
    context.arc(x, y, 6 + 18 * part, 0, 2 * Math.PI);
    context.stroke();
  }
  context.globalAlpha = 1;
}
