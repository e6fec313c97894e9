// SPDX-License-Identifier: Apache-2.0
import type { Drive } from "../model/drive.ts";
import type { Place } from "../model/places.ts";
import type { Colours } from "../ui/colours.ts";
import { Declutter } from "./declutter.ts";
import { haloText } from "./draw_ground.ts";
import { Sprites, stamp } from "./sprites.ts";
import type { View } from "./view.ts";

const labels_from_px_per_m = 4;
const sprites = new Sprites();

function isNear(view: View, x: number, y: number, margin = 20): boolean {
  return x > -margin && y > -margin && x < view.width + margin && y < view.height + margin;
}

/** Discs; junctions are diamonds. */
export function drawPlaces(context: CanvasRenderingContext2D, drive: Drive, view: View, colours: Colours): void {
  const small = view.px_per_m < 2;
  const radius = small ? 3.5 : 5.5;
  const disc = sprites.of("disc", radius, colours);
  const diamond = sprites.of("diamond", radius, colours);
  const declutter = new Declutter(small ? 5 : 3);
  const labelled: { text: string; x: number; y: number }[] = [];
  const room = new Declutter(44);
  for (const { id, isJunction, pose } of drive.places.all.values()) {
    const { x, y } = view.toScreen(pose.x, pose.y);
    if (!isNear(view, x, y) || !declutter.takes(x, y)) continue;
    stamp(context, isJunction ? diamond : disc, x, y);
    if (view.px_per_m >= labels_from_px_per_m && room.takes(x, y)) labelled.push({ text: String(id), x, y });
  }
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
