// SPDX-License-Identifier: Apache-2.0
/** What a press on the map does: nothing special, measure lengths, or give the vehicle its pose. */
import { distance, wrapped, type Pose2 } from "../model/geometry.ts";
import { metres } from "../model/state_line.ts";
import type { Colours } from "../ui/colours.ts";
import { haloText } from "./draw_ground.ts";
import { drawArrow } from "./draw_vehicle.ts";
import type { View } from "./view.ts";

const turn_rad = (5 * Math.PI) / 180; // of one key

export interface Point {
  x: number;
  y: number;
}

export interface Tool {
  readonly hint: string;
  /** Whether a drag belongs to the tool; otherwise it moves the map. */
  readonly takesDrags: boolean;
  tap(at: Point): void;
  drag(from: Point, to: Point): void;
  drop(): void;
  turn(by: 1 | -1): void;
  draw(context: CanvasRenderingContext2D, view: View, colours: Colours): void;
}

/** Lengths between points that are tapped one after the other. */
export class MeasureTool implements Tool {
  readonly takesDrags = false;
  points: Point[] = [];

  get hint(): string {
    if (this.points.length === 0) return "Measure: tap the first point";
    if (this.points.length === 1) return "Measure: tap the next point";
    return `${metres(this.total_m)} in all`;
  }

  get total_m(): number {
    return this.points.slice(1).reduce((sum, point, i) => sum + distance(this.points[i]!, point), 0);
  }

  tap(at: Point): void {
    this.points.push(at);
  }

  drag(): void {}
  drop(): void {}
  turn(): void {}

  draw(context: CanvasRenderingContext2D, view: View, colours: Colours): void {
    const pixels = this.points.map(({ x, y }) => view.toScreen(x, y));
    context.beginPath();
    for (const { x, y } of pixels) context.lineTo(x, y);
    context.lineWidth = 2;
    context.strokeStyle = colours.ink;
    context.stroke();
    context.fillStyle = colours.ink;
    for (const { x, y } of pixels) {
      context.beginPath();
      context.arc(x, y, 3.5, 0, 2 * Math.PI);
      context.fill();
    }
    pixels.slice(1).forEach((to, i) => {
      const from = pixels[i]!;
      haloText(context, metres(distance(this.points[i]!, this.points[i + 1]!)), (from.x + to.x) / 2, (from.y + to.y) / 2 - 8, colours, "center");
    });
  }
}

/** The pose of the vehicle: pressed at its place, drawn towards where it heads. Given only after it was confirmed. */
export class PlaceTool implements Tool {
  readonly takesDrags = true;
  pose: Pose2 | undefined;

  /** `yaw`: where it heads unless drawn otherwise. */
  constructor(
    readonly yaw: number,
    readonly onProposed: (pose: Pose2) => void,
  ) {}

  get hint(): string {
    return this.pose ? "" : "Press where the vehicle is and draw towards where it heads";
  }

  tap(at: Point): void {
    this.pose = { ...at, yaw: this.pose?.yaw ?? this.yaw };
    this.onProposed(this.pose);
  }

  drag(from: Point, to: Point): void {
    this.pose = { ...from, yaw: Math.atan2(to.y - from.y, to.x - from.x) };
  }

  drop(): void {
    if (this.pose) this.onProposed(this.pose);
  }

  turn(by: 1 | -1): void {
    if (this.pose) this.onProposed((this.pose = { ...this.pose, yaw: wrapped(this.pose.yaw + by * turn_rad) }));
  }

  draw(context: CanvasRenderingContext2D, view: View, colours: Colours): void {
    if (!this.pose) return;
    const { x, y } = view.toScreen(this.pose.x, this.pose.y);
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + 60 * Math.cos(this.pose.yaw), y - 60 * Math.sin(this.pose.yaw));
    context.lineWidth = 2;
    context.strokeStyle = colours.good;
    context.stroke();
    drawArrow(context, view, this.pose, colours.good, colours.card, 15);
  }
}
