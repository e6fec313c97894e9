// SPDX-License-Identifier: Apache-2.0
/** Draws the points that the odometry follows into the left image, and says how many there are of each kind. */
import { FeatureState, type Trail } from "../model/features.ts";
import { h, setText } from "../ui/dom.ts";

const kinds = [
  { state: FeatureState.inlier, name: "inlier", text: "follow the motion", colour: "#35c99b" },
  { state: FeatureState.outlier, name: "outlier", text: "contradict it", colour: "#ff9148" },
  { state: FeatureState.new, name: "new", text: "new", colour: "#e8e6e0" },
];

const dot_px = 0.0035; // of the width of the image

export function drawFeatures(context: CanvasRenderingContext2D, trails: Trail[]): void {
  const size = Math.max(1.5, context.canvas.width * dot_px);
  context.lineWidth = size / 2;
  for (const { state, colour } of kinds) {
    const ofKind = trails.filter((trail) => trail.state === state);
    context.strokeStyle = context.fillStyle = colour;
    context.beginPath();
    for (const { way } of ofKind) way.forEach(({ u, v }, i) => (i === 0 ? context.moveTo(u, v) : context.lineTo(u, v)));
    context.stroke();
    for (const { way } of ofKind) context.fillRect(way[0]!.u - size, way[0]!.v - size, 2 * size, 2 * size);
  }
}

export class FeatureLegend {
  #counts = new Map(kinds.map(({ state }) => [state as number, h("b")]));
  element = h("p.legend", { hidden: true }, ...kinds.map(({ state, name, text }) => h(`span.${name}`, {}, this.#counts.get(state)!, ` ${text}`)));

  show(trails: Trail[]): void {
    this.element.hidden = false;
    for (const [state, count] of this.#counts) setText(count, String(trails.filter((trail) => trail.state === state).length));
  }
}
