// SPDX-License-Identifier: Apache-2.0
import type { Drive } from "../model/drive.ts";
import { ninetyFivePercent, type Pose2 } from "../model/geometry.ts";
import type { Colours } from "../ui/colours.ts";
import type { View } from "./view.ts";

/** An arrowhead of constant size that points where the vehicle heads. */
export function drawArrow(context: CanvasRenderingContext2D, view: View, { x, y, yaw }: Pose2, fill: string, outline: string, size = 13): void {
  const at = view.toScreen(x, y);
  context.save();
  context.translate(at.x, at.y);
  context.rotate(-yaw);
  context.beginPath();
  context.moveTo(size, 0);
  context.lineTo(-size * 0.8, size * 0.72);
  context.lineTo(-size * 0.42, 0);
  context.lineTo(-size * 0.8, -size * 0.72);
  context.closePath();
  context.lineJoin = "round";
  context.lineWidth = 5;
  context.strokeStyle = outline;
  context.stroke();
  context.fillStyle = fill;
  context.fill();
  context.restore();
}

/** Around the vehicle: the ellipse with 95 % of the position, and the circle of the protection level. */
export function drawUncertainty(context: CanvasRenderingContext2D, drive: Drive, view: View, colours: Colours): void {
  const pose = drive.pose;
  if (!pose) return;
  const at = view.toScreen(pose.x, pose.y);
  const { ellipse, integrity } = drive;
  if (integrity && Number.isFinite(integrity.horizontal_protection_level_m)) {
    const colour = integrity.usable ? colours.enhanced : colours.caution;
    context.beginPath();
    context.arc(at.x, at.y, integrity.horizontal_protection_level_m * view.px_per_m, 0, 2 * Math.PI);
    fillFaintly(context, colour, 0.1);
    context.lineWidth = 1.25;
    context.setLineDash([5, 4]);
    context.strokeStyle = colour;
    context.stroke();
    context.setLineDash([]);
  }
  if (!ellipse) return;
  context.beginPath();
  const scale = ninetyFivePercent * view.px_per_m;
  context.ellipse(at.x, at.y, ellipse.major * scale, ellipse.minor * scale, -ellipse.angle, 0, 2 * Math.PI);
  fillFaintly(context, colours.enhanced, 0.22);
  context.lineWidth = 1.5;
  context.strokeStyle = colours.enhanced;
  context.stroke();
}

function fillFaintly(context: CanvasRenderingContext2D, colour: string, alpha: number): void {
  context.globalAlpha = alpha;
  context.fillStyle = colour;
  context.fill();
  context.globalAlpha = 1;
}
