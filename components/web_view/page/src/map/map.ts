// SPDX-License-Identifier: Apache-2.0
/** The map: what is drawn in which order, and what a tap hits. */
import type { Drive } from "../model/drive.ts";
import { nowhere, widen } from "../model/path.ts";
import type { Place } from "../model/places.ts";
import { onSchemeChange, readColours } from "../ui/colours.ts";
import { drawGrid, drawMiddle, drawScaleBar } from "./draw_ground.ts";
import { drawRings } from "./draw_places.ts";
import { drawFresh } from "./draw_sightings.ts";
import { drawArrow, drawUncertainty } from "./draw_vehicle.ts";
import { listen } from "./gestures.ts";
import type { Layers } from "./scene.ts";
import { SceneCache } from "./scene_cache.ts";
import type { Tool } from "./tools.ts";
import { View } from "./view.ts";

const hit_px = 14;

export class MapView {
  view = new View();
  follows = true;
  layers: Layers = { enhanced: true, binocular: true, truth: true, places: true, sightings: true, corrections: true, uncertainty: true };
  tool: Tool | undefined;
  chosen: number | undefined; // id of a place
  cursor_s: number | undefined; // time of the linked cursor
  covered_px = (): number => 0; // at the left, by something that lies over the map
  onChange = (): void => {}; // tool, following or chosen place
  frames = 0;
  #colours = readColours();
  #context: CanvasRenderingContext2D;
  #scene = new SceneCache();
  #isDue = false;
  #drawn = -1;

  constructor(
    readonly canvas: HTMLCanvasElement,
    readonly drive: Drive,
  ) {
    this.#context = canvas.getContext("2d", { alpha: false })!;
    new ResizeObserver(() => this.#resize()).observe(canvas);
    onSchemeChange(() => {
      this.#colours = readColours();
      this.draw();
    });
    this.#resize();
    listen(canvas, {
      tap: (x, y) => this.#tap(x, y),
      drag: (from, to) => {
        if (!this.tool?.takesDrags) return false;
        this.tool.drag(this.view.toMap(from.x, from.y), this.view.toMap(to.x, to.y));
        this.draw();
        return true;
      },
      drop: () => this.tool?.drop(),
      move: (dx, dy) => {
        this.view.move(dx, dy);
        this.follow(false);
      },
      zoom: (factor, x, y) => {
        this.view.zoom(factor, ...(this.follows ? [] : [x, y]));
        this.draw();
      },
      turn: (by) => {
        this.tool?.turn(by);
        this.draw();
      },
      hover: (x, y) => (canvas.style.cursor = this.tool ? "crosshair" : this.#placeAt(x, y) ? "pointer" : ""),
    });
  }

  /** Draws with the next frame. */
  draw(): void {
    if (this.#isDue) return;
    this.#isDue = true;
    requestAnimationFrame(() => {
      this.#isDue = false;
      this.#drawNow();
    });
  }

  /** Draws if there is something new. */
  update(): void {
    if (this.#drawn !== this.drive.version) this.draw();
  }

  follow(follows: boolean): void {
    if (this.follows !== follows) {
      this.follows = follows;
      this.onChange();
    }
    this.draw();
  }

  fit(): void {
    const bounds = nowhere();
    for (const path of [this.drive.enhanced, this.drive.enhanced.count > 0 ? undefined : this.drive.binocular]) {
      if (!path || path.count === 0) continue;
      const { left, right, bottom, top } = path.bounds();
      widen(bounds, left, bottom);
      widen(bounds, right, top);
    }
    for (const { pose } of this.drive.places.all.values()) widen(bounds, pose.x, pose.y);
    this.view.fit(bounds, this.covered_px());
    this.follow(false);
  }

  centre({ x, y }: { x: number; y: number }): void {
    Object.assign(this.view, { x, y });
    this.follow(false);
  }

  choose(id: number | undefined): void {
    this.chosen = id;
    this.onChange();
    this.draw();
  }

  setTool(tool: Tool | undefined): void {
    this.tool = tool;
    if (tool) this.canvas.focus(); // so that keys reach it
    this.chosen = undefined;
    this.onChange();
    this.draw();
  }

  #tap(x: number, y: number): void {
    if (this.tool) {
      this.tool.tap(this.view.toMap(x, y));
      this.onChange();
      this.draw();
    } else {
      this.choose(this.#placeAt(x, y)?.id);
    }
  }

  #placeAt(x: number, y: number): Place | undefined {
    let best: Place | undefined;
    let nearest = hit_px;
    for (const place of this.drive.places.all.values()) {
      const at = this.view.toScreen(place.pose.x, place.pose.y);
      const away = Math.hypot(at.x - x, at.y - y);
      if (away < nearest) [best, nearest] = [place, away];
    }
    return best;
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.view.width = Math.max(1, clientWidth);
    this.view.height = Math.max(1, clientHeight);
    this.canvas.width = Math.round(clientWidth * devicePixelRatio);
    this.canvas.height = Math.round(clientHeight * devicePixelRatio);
    this.#drawNow();
  }

  #drawNow(): void {
    const { drive, view, layers } = this;
    const context = this.#context;
    const colours = this.#colours;
    this.#drawn = drive.version;
    ++this.frames;
    const pose = drive.pose;
    if (this.follows && pose) Object.assign(view, { x: pose.x, y: pose.y });
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.fillStyle = colours.card;
    context.fillRect(0, 0, view.width, view.height);
    drawGrid(context, view, colours);
    if (this.#scene.draw(context, drive, layers, view, colours, performance.now())) this.draw();
    if (layers.places) drawRings(context, drive, view, colours, this.chosen);
    if (layers.corrections) drawFresh(context, drive, view, colours);
    if (layers.uncertainty) drawUncertainty(context, drive, view, colours);
    if (pose) drawArrow(context, view, pose, drive.enhanced.count === 0 ? colours.binocular : colours.enhanced, colours.card);
    this.#drawCursor();
    this.tool?.draw(context, view, colours);
    if (this.tool && this.canvas.matches(":focus-visible")) drawMiddle(context, view, colours);
    drawScaleBar(context, view, colours);
  }

  #drawCursor(): void {
    const { drive } = this;
    const path = drive.enhanced.count > 0 ? drive.enhanced : drive.binocular;
    const index = this.cursor_s === undefined ? -1 : path.indexAt(this.cursor_s);
    if (index < 0) return;
    drawArrow(this.#context, this.view, path.at(index), this.#colours.ink, this.#colours.card, 10);
  }
}
