// SPDX-License-Identifier: Apache-2.0
/**
 * A picture of what stands still, larger than the screen. While the map moves or poses come, it is shown again, and only the newest poses
 * are drawn; so the time of a frame does not depend on the length of the drive.
 */
import type { Drive } from "../model/drive.ts";
import type { Colours } from "../ui/colours.ts";
import { drawLine, drawScene, linesOf, type Layers } from "./scene.ts";
import { View } from "./view.ts";

const margin = 0.25; // of the screen, on each side
const settled_ms = 120; // after the last change of scale, until the picture is redrawn sharply
const most_scaled = 2.5;
const ahead = 1.5; // while the map shrinks, the picture is made for a scale that is smaller by this, so that it lasts twice as long
const most_newest = 500; // poses drawn on top of the picture in each frame

export class SceneCache {
  #canvas = document.createElement("canvas");
  #context = this.#canvas.getContext("2d")!;
  #view = new View(); // of the picture
  #content = ""; // key of what the picture shows, without the newest poses
  #counts: number[] = []; // poses in the picture, by line
  #scaled_ms = 0; // time of the last change of scale
  #scale = 0;

  /** Draws; returns whether it must be called again soon, for a sharper picture. */
  draw(context: CanvasRenderingContext2D, drive: Drive, layers: Layers, view: View, colours: Colours, now_ms: number): boolean {
    const shrinks = view.px_per_m < this.#scale;
    if (view.px_per_m !== this.#scale) [this.#scale, this.#scaled_ms] = [view.px_per_m, now_ms];
    const lines = linesOf(drive, layers);
    const content = JSON.stringify([
      lines.map(({ path, mapFromOwn }) => [path.revision, mapFromOwn]), drive.places.version, drive.correctionsTaken, layers, colours.page, view.width, view.height, devicePixelRatio,
    ]);
    const isSharp = this.#view.px_per_m === view.px_per_m;
    const mayBeScaled = now_ms - this.#scaled_ms < settled_ms && Math.abs(Math.log(view.px_per_m / this.#view.px_per_m)) < Math.log(most_scaled);
    const newest = lines.reduce((sum, { path }, i) => sum + path.count - (this.#counts[i] ?? 0), 0);
    if (content !== this.#content || newest > most_newest || !this.#covers(view) || !(isSharp || mayBeScaled)) {
      this.#content = content;
      this.#counts = lines.map(({ path }) => path.count);
      this.#render(drive, layers, shrinks ? Object.assign(new View(), view, { px_per_m: view.px_per_m / ahead }) : view, colours);
    }
    this.#show(context, view);
    // Each line begins a little before the one below it, whose end would cover it.
    lines.forEach((line, i) => line.path.count > this.#counts[i]! && drawLine(context, line, view, colours, Math.max(0, this.#counts[i]! - 1 - 3 * i)));
    return this.#view.px_per_m !== view.px_per_m;
  }

  #covers(view: View): boolean {
    const has = this.#view.seen();
    const needs = view.seen();
    return has.left <= needs.left && has.right >= needs.right && has.bottom <= needs.bottom && has.top >= needs.top;
  }

  #render(drive: Drive, layers: Layers, view: View, colours: Colours): void {
    const { x, y, px_per_m } = view;
    Object.assign(this.#view, { x, y, px_per_m, width: view.width * (1 + 2 * margin), height: view.height * (1 + 2 * margin) });
    const width = Math.round(this.#view.width * devicePixelRatio);
    const height = Math.round(this.#view.height * devicePixelRatio);
    if (this.#canvas.width !== width || this.#canvas.height !== height) Object.assign(this.#canvas, { width, height });
    this.#context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    this.#context.clearRect(0, 0, this.#view.width, this.#view.height);
    drawScene(this.#context, drive, layers, this.#view, colours);
  }

  #show(context: CanvasRenderingContext2D, view: View): void {
    const scale = view.px_per_m / this.#view.px_per_m;
    const corner = this.#view.toMap(0, 0);
    const { x, y } = view.toScreen(corner.x, corner.y);
    const whole = (value: number) => (scale === 1 ? Math.round(value * devicePixelRatio) / devicePixelRatio : value);
    context.drawImage(this.#canvas, whole(x), whole(y), this.#view.width * scale, this.#view.height * scale);
  }
}
