// SPDX-License-Identifier: Apache-2.0
import { composed, identity, type Pose2 } from "../model/geometry.ts";
import { Path, type Bounds } from "../model/path.ts";
import type { View } from "./view.ts";

/** What is used of a canvas. */
export interface Pen {
  moveTo(x: number, y: number): void;
  lineTo(x: number, y: number): void;
}

const least_px = 1.5; // smallest distance between two points of a line
const jump_m = 100; // neighbours farther apart are not joined by a line

function isSeen(chunk: Bounds, seen: Bounds): boolean {
  return chunk.right >= seen.left && chunk.left <= seen.right && chunk.top >= seen.bottom && chunk.bottom <= seen.top;
}

/** Bounds, in the path's own frame, that surely contain those in the map. */
function ofOwnFrame(seen: Bounds, mapFromOwn: Pose2): Bounds {
  if (mapFromOwn === identity) return seen;
  const radius = Math.hypot(seen.right - seen.left, seen.top - seen.bottom) / 2;
  const dx = (seen.left + seen.right) / 2 - mapFromOwn.x;
  const dy = (seen.bottom + seen.top) / 2 - mapFromOwn.y;
  const cos = Math.cos(mapFromOwn.yaw);
  const sin = Math.sin(mapFromOwn.yaw);
  const x = cos * dx + sin * dy;
  const y = -sin * dx + cos * dy;
  return { left: x - radius, right: x + radius, bottom: y - radius, top: y + radius };
}

/**
 * Draws a path that lies in the map at `mapFromOwn`. Leaves out what is not seen, and points that are nearer to each other than
 * can be seen. `from`: index of the first pose. Returns the number of points.
 */
export function trace(pen: Pen, path: Path, view: View, mapFromOwn: Pose2 = identity, from = 0): number {
  const seen = ofOwnFrame(view.seen(20), mapFromOwn);
  const origin = composed(mapFromOwn, identity);
  const cos = Math.cos(origin.yaw) * view.px_per_m;
  const sin = Math.sin(origin.yaw) * view.px_per_m;
  const start = view.toScreen(origin.x, origin.y);
  const nearest = least_px * least_px;
  let points = 0;
  let isDown = false;
  let lastX = 0;
  let lastY = 0;
  for (let chunk = Math.floor(from / Path.chunk); chunk < path.chunks.length; ++chunk) {
    if (!isSeen(path.chunks[chunk]!, seen)) {
      isDown = false;
      continue;
    }
    const begin = Math.max(from, chunk * Path.chunk - 1); // joined to the chunk before
    const end = Math.min(path.count, (chunk + 1) * Path.chunk);
    for (let i = isDown ? begin + 1 : begin; i < end; ++i) {
      const x = start.x + cos * path.xs[i]! - sin * path.ys[i]!;
      const y = start.y - sin * path.xs[i]! - cos * path.ys[i]!;
      const gap = (x - lastX) ** 2 + (y - lastY) ** 2;
      if (isDown && gap < nearest && i < path.count - 1) continue;
      if (isDown && gap < (jump_m * view.px_per_m) ** 2) pen.lineTo(x, y);
      else pen.moveTo(x, y);
      isDown = true;
      lastX = x;
      lastY = y;
      ++points;
    }
  }
  return points;
}
