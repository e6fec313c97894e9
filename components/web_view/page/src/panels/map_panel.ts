// SPDX-License-Identifier: Apache-2.0
/** What lies over the map: layers, buttons, hints, the chosen place, and the vehicle to be placed. */
import { Thumbnails } from "../cameras/thumbnails.ts";
import type { MapView } from "../map/map.ts";
import type { Layers } from "../map/scene.ts";
import { MeasureTool, PlaceTool } from "../map/tools.ts";
import type { Drive } from "../model/drive.ts";
import type { Pose2 } from "../model/geometry.ts";
import { byId, clock, h, setText } from "../ui/dom.ts";

const layerTexts: [keyof Layers, string, string][] = [
  ["enhanced", "Pose in the map", "enhanced"],
  ["binocular", "Stereo odometry alone", "binocular"],
  ["truth", "Ground truth", "truth"],
  ["places", "Places", "landmark"],
  ["sightings", "Sightings of places", "good"],
  ["corrections", "Corrections", "good"],
  ["uncertainty", "95 % and protection level", "enhanced"],
];

export class MapPanel {
  #layers = new Map<keyof Layers, HTMLElement>();
  #thumbnails = new Thumbnails(() => this.#showPlace());
  #proposed: Pose2 | undefined;

  constructor(
    readonly map: MapView,
    readonly drive: Drive,
    readonly onPlace: (pose: Pose2) => void,
  ) {
    this.#makeLayers();
    const buttons: Record<string, () => void> = {
      "zoom-in": () => this.#zoom(1.5),
      "zoom-out": () => this.#zoom(1 / 1.5),
      follow: () => map.follow(!map.follows),
      fit: () => map.fit(),
      measure: () => this.toggleMeasure(),
      place: () => this.togglePlace(),
      "place-yes": () => this.#confirm(true),
      "place-no": () => this.#confirm(false),
      "card-close": () => map.choose(undefined),
      "layers-toggle": () => byId("legend").classList.toggle("open"),
    };
    for (const [id, call] of Object.entries(buttons)) byId(id).addEventListener("click", call);
    map.onChange = () => this.#onChange();
    map.covered_px = () => (byId("legend").offsetWidth < map.view.width / 3 ? byId("legend").offsetWidth : 0);
    this.#onChange();
  }

  setControl(isAllowed: boolean): void {
    byId("place").hidden = !isAllowed;
    if (!isAllowed && this.map.tool instanceof PlaceTool) this.cancel();
  }

  /** Layers without content are not listed. */
  update(): void {
    const { drive } = this;
    const has: Record<keyof Layers, boolean> = {
      enhanced: drive.enhanced.count > 0,
      binocular: drive.binocular.count > 0,
      truth: drive.mapFromTruth !== undefined,
      places: drive.places.all.size > 0,
      sightings: drive.corrections.length > 0,
      corrections: drive.corrections.length > 0,
      uncertainty: drive.ellipse !== undefined || drive.integrity !== undefined,
    };
    for (const [layer, element] of this.#layers) element.hidden = !has[layer];
    const isEmpty = !drive.pose && drive.places.all.size === 0;
    byId("empty").hidden = !isEmpty;
    byId("legend").hidden = isEmpty;
    this.#showPlace();
  }

  toggleMeasure(): void {
    this.map.setTool(this.map.tool instanceof MeasureTool ? undefined : new MeasureTool());
  }

  togglePlace(): void {
    if (byId("place").hidden) return;
    this.#proposed = undefined;
    this.map.setTool(
      this.map.tool instanceof PlaceTool
        ? undefined
        : new PlaceTool(this.drive.pose?.yaw ?? 0, (pose) => {
            this.#proposed = pose;
            this.#onChange();
          }),
    );
  }

  cancel(): void {
    this.#proposed = undefined;
    this.map.setTool(undefined);
  }

  #zoom(factor: number): void {
    this.map.view.zoom(factor);
    this.map.draw();
  }

  #confirm(isYes: boolean): void {
    const pose = this.#proposed;
    this.cancel();
    if (isYes && pose) this.onPlace(pose);
  }

  #makeLayers(): void {
    for (const [layer, text, colour] of layerTexts) {
      const box = h("input", { type: "checkbox", checked: true });
      box.onchange = () => {
        this.map.layers[layer] = box.checked;
        this.map.draw();
      };
      const swatch = h("i");
      swatch.className = `swatch ${layer}`;
      swatch.style.setProperty("--colour", `var(--${colour})`);
      const label = h("label", {}, box, swatch, text);
      this.#layers.set(layer, label);
      byId("legend").append(label);
    }
  }

  #onChange(): void {
    const { map } = this;
    byId("follow").setAttribute("aria-pressed", String(map.follows));
    byId("measure").setAttribute("aria-pressed", String(map.tool instanceof MeasureTool));
    byId("place").setAttribute("aria-pressed", String(map.tool instanceof PlaceTool));
    setText(byId("hint"), map.tool?.hint ?? "");
    byId("hint").hidden = !map.tool?.hint;
    byId("confirm").hidden = !this.#proposed;
    if (this.#proposed) {
      const { x, y, yaw } = this.#proposed;
      setText(byId("confirm-text"), `Place the vehicle at x ${x.toFixed(1)} m, y ${y.toFixed(1)} m, heading ${Math.round((yaw * 180) / Math.PI)}°?`);
    }
    map.canvas.style.cursor = map.tool ? "crosshair" : "";
    this.#showPlace();
  }

  #showPlace(): void {
    const place = this.map.chosen === undefined ? undefined : this.drive.places.all.get(this.map.chosen);
    byId("card").hidden = !place;
    if (!place) return;
    setText(byId("card-title"), `Place ${place.id}`);
    const built = place.built_s >= this.drive.begin ? `remembered at ${clock(place.built_s - this.drive.begin)}` : "from an earlier drive";
    const seen = place.corrections === 0 ? "not seen again yet" : `corrected the position ${place.corrections === 1 ? "once" : `${place.corrections} times`}`;
    setText(byId("card-text"), [place.isJunction ? "Junction" : "", built, seen].filter(Boolean).join(" · "));
    const picture = byId("card-picture");
    const image = this.#thumbnails.get(place);
    if (image && picture.firstChild !== image) picture.replaceChildren(image);
    if (!image) picture.replaceChildren();
  }
}
