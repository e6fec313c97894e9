// SPDX-License-Identifier: Apache-2.0
/** The panorama with its directions, the recognised place below it, turned to the same heading, and the left image. */
import { imageTypes, preferredImage } from "../link/roles.ts";
import type { Drive } from "../model/drive.ts";
import { momentOf } from "../model/moment.ts";
import { clock, h, setText } from "../ui/dom.ts";
import { FeatureLegend, drawFeatures } from "./features.ts";
import { shiftOf, sidesOf, ticksOf } from "./heading_tape.ts";
import { MatchLines, linesBetween, shownIn } from "./match_lines.ts";
import { Picture } from "./picture.ts";
import { RecordedPictures } from "./recorded_pictures.ts";
import { Thumbnails } from "./thumbnails.ts";
import { WaitingImages, type ImageHappening } from "./waiting_images.ts";

const matchAge_s = 0.7; // between the panorama that is shown and the one whose points are known

type Kind = "panorama" | "left";

/** A tap shows the whole height of the picture, another one its middle again. */
function pictureFrame(...children: HTMLElement[]): HTMLElement {
  const frame = h("div.frame", { onclick: () => frame.classList.toggle("whole") }, ...children);
  return frame;
}

class Camera {
  picture = new Picture();
  topic: string | undefined;
  #isChosen = false; // by the user; otherwise a better topic that appears later is taken
  frame = "";
  stamp_s = NaN;
  select = h("select", { "aria-label": "Topic of the image" });
  note = h("p.note");
  tape = h("div.tape");
  element: HTMLElement;

  constructor(
    readonly kind: Kind,
    title: string,
    onChoice: () => void,
  ) {
    this.select.onchange = () => {
      this.topic = this.select.value;
      this.#isChosen = true;
      onChoice();
    };
    const frame = pictureFrame(this.picture.canvas, this.tape, this.note);
    this.element = h("figure.camera", { hidden: true }, h("figcaption", {}, h("b", {}, title), this.select), frame);
    this.element.classList.add(kind);
  }

  offer(topics: string[], isNear: boolean): void {
    if (!this.#isChosen || !this.topic || !topics.includes(this.topic)) this.topic = preferredImage(topics, this.kind, isNear) ?? this.topic;
    this.element.hidden = topics.length === 0 && this.picture.isEmpty;
    const options = [...new Set([...(this.topic ? [this.topic] : []), ...topics])];
    this.select.replaceChildren(...options.map((topic) => h("option", { value: topic, selected: topic === this.topic }, topic.replace(/^\//, ""))));
    if (this.picture.isEmpty) setText(this.note, this.topic ? "waiting for the first image" : "no topic chosen");
  }
}

export class Cameras {
  #panorama: Camera;
  #left: Camera;
  #place = new Picture();
  #placeCaption = h("span");
  #lines = new MatchLines();
  #placeElement: HTMLElement;
  #thumbnails = new Thumbnails(() => (this.#drawnPlace = ""));
  #drawnPlace = "";
  #legend = new FeatureLegend();
  #drawnFeatures_s = NaN; // stamp of the image into which they are drawn
  #waiting = new WaitingImages();
  #isVisible = true;
  #recorded: RecordedPictures[] = [];
  #cursor_s: number | undefined;
  readonly empty = h("p.empty", {}, "No camera publishes images.");

  constructor(
    readonly element: HTMLElement,
    readonly drive: Drive,
    readonly onTopics: (topics: string[]) => void,
  ) {
    this.#panorama = new Camera("panorama", "Panorama", () => this.#tellTopics());
    this.#left = new Camera("left", "Left camera", () => {
      this.#waiting.clear();
      this.#tellTopics();
    });
    this.#left.element.append(this.#legend.element);
    this.#placeElement = h("figure.camera.place", { hidden: true }, h("figcaption", {}, this.#placeCaption, this.#lines.button), pictureFrame(this.#place.canvas), this.#lines.legend);
    const pair = h("div.pair", {}, this.#panorama.element, this.#placeElement, this.#lines.canvas);
    element.append(this.empty, pair, this.#left.element);
  }

  /** `isNear`: the server is on this machine, so that images need not be small. */
  offer(topics: { topic: string; type: string }[], isNear: boolean): void {
    const images = topics.filter(({ type }) => imageTypes.includes(type)).map(({ topic }) => topic);
    this.empty.hidden = images.length > 0;
    this.#panorama.offer(images, isNear);
    this.#left.offer(images, isNear);
    this.#tellTopics();
  }

  /** Images are received only while they are seen. */
  setVisible(isVisible: boolean): void {
    this.#isVisible = isVisible;
    if (!isVisible) this.#waiting.clear();
    this.#tellTopics();
  }

  show(image: ImageHappening): void {
    const camera = [this.#panorama, this.#left].find((one) => one.topic === image.topic);
    if (!camera) return image.bitmap.close();
    if (camera !== this.#left) return this.#showIn(camera, image);
    const due = this.#hasFeatures ? this.#waiting.add(image, this.drive.features) : image;
    if (due) this.#showIn(camera, due);
  }

  /** Shows the image to which the points belong that have just come. */
  onFeatures(): void {
    const due = this.#waiting.take(this.drive.features.newest);
    if (due) this.#showIn(this.#left, due);
  }

  #showIn(camera: Camera, { frame, stamp_s, bitmap }: ImageHappening): void {
    Object.assign(camera, { frame, stamp_s });
    camera.picture.show(bitmap);
    camera.element.hidden = false;
    setText(camera.note, "");
    if (camera === this.#left) this.#updateFeatures();
  }

  /** The points are those of the rectified image. */
  get #hasFeatures(): boolean {
    return this.#left.topic?.includes("image_rect") ?? false;
  }

  fault(topic: string, why: string): void {
    for (const camera of [this.#panorama, this.#left]) if (camera.topic === topic) setText(camera.note, why);
  }

  update(): void {
    this.#updateTape();
    this.#updatePlace();
    this.#updateLines();
    this.#updateFeatures();
  }

  /** Whether there is a camera of which no image has come yet. */
  get isWaiting(): boolean {
    return [this.#panorama, this.#left].some(({ topic, picture }) => topic !== undefined && picture.isEmpty);
  }

  /** The last images, for a snapshot. */
  pictures(): Partial<Record<Kind, string>> {
    const taken: Partial<Record<Kind, string>> = {};
    for (const { kind, picture } of [this.#panorama, this.#left]) if (!picture.isEmpty) taken[kind] = picture.canvas.toDataURL("image/jpeg", 0.8);
    return taken;
  }

  restore(kind: Kind, picture: HTMLImageElement, frame: string): void {
    const camera = kind === "left" ? this.#left : this.#panorama;
    camera.frame = frame;
    camera.picture.show(picture);
    camera.element.hidden = false;
    this.empty.hidden = true;
  }

  /** Pictures along a recorded drive, instead of topics. */
  keep(pictures: Record<Kind, [time: number, jpeg: string][]>, panoramaFrame: string): void {
    const kinds = ["left", "panorama"] as const;
    this.#recorded = kinds.map((kind) => new RecordedPictures(pictures[kind], (picture) => this.restore(kind, picture, panoramaFrame)));
    setText(this.empty, "The recording has no images.");
  }

  /** `time`: undefined: now. */
  showAt(time: number | undefined): void {
    this.#cursor_s = time;
    for (const pictures of this.#recorded) pictures.show(time ?? Infinity);
    this.update();
  }

  get panoramaFrame(): string {
    return this.#panorama.frame;
  }

  #tellTopics(): void {
    const topics = [this.#panorama, this.#left].map(({ topic }) => topic).filter((topic) => topic !== undefined);
    this.onTopics(this.#isVisible ? topics : []);
  }

  #updateTape(): void {
    const { pose } = momentOf(this.drive, this.#cursor_s);
    const { tape, frame, picture } = this.#panorama;
    if (!pose || picture.isEmpty) return;
    const centre = pose.yaw + (this.drive.yawOfFrame.get(frame) ?? 0);
    const marks = [
      ...ticksOf(centre).filter(({ isMain }) => isMain).map(({ at, text }) => ({ at, text, name: "azimuth" })),
      ...sidesOf(pose.yaw, centre).map(({ at, text }) => ({ at, text, name: "side" })),
    ];
    while (tape.children.length < marks.length) tape.append(h("span"));
    marks.forEach(({ at, text, name }, i) => {
      const mark = tape.children[i] as HTMLElement;
      mark.className = name;
      mark.style.left = `clamp(1.6em, ${(at * 100).toFixed(2)}%, 100% - 1.6em)`;
      setText(mark, text);
    });
  }

  #updateFeatures(): void {
    const { picture, stamp_s } = this.#left;
    if (stamp_s === this.#drawnFeatures_s || !this.#hasFeatures) return;
    const trails = this.drive.features.at(stamp_s);
    if (!trails) return;
    this.#drawnFeatures_s = stamp_s;
    picture.draw((context) => drawFeatures(context, trails));
    this.#legend.show(trails);
  }

  #updatePlace(): void {
    const { recognised, time } = momentOf(this.drive, this.#cursor_s);
    const place = recognised && this.drive.places.all.get(recognised.place);
    this.#placeElement.hidden = !place?.thumbnail;
    if (!recognised || !place?.thumbnail) return;
    const degrees = Math.round((Math.abs(recognised.heading) * 180) / Math.PI);
    const since = time - recognised.time;
    setText(this.#placeCaption, `Place ${place.id}, ${since < 1 ? "seen now" : `seen ${clock(since)} ago`}, turned by ${degrees}°`);
    this.#placeElement.classList.toggle("past", since > 3);
    const key = `${place.id} ${recognised.heading.toFixed(3)}`;
    const image = this.#thumbnails.get(place);
    if (!image || key === this.#drawnPlace) return;
    this.#drawnPlace = key;
    this.#place.show(image, shiftOf(recognised.heading));
  }

  /** Of the place below, if the panorama that is shown is one of those in which it was recognised. */
  #updateLines(): void {
    const { matches, recognised } = this.drive;
    const isShown = matches && matches.place === recognised?.place && !this.#placeElement.hidden && Math.abs(this.#panorama.stamp_s - matches.time) < matchAge_s;
    if (!isShown || this.#panorama.picture.isEmpty || this.#place.isEmpty) return this.#lines.show(undefined, "", () => []);
    const shift = shiftOf(recognised.heading);
    const whole = [...this.element.querySelectorAll(".frame")].map((frame) => frame.classList.contains("whole")).join();
    this.#lines.show(matches.points, `${matches.time} ${shift.toFixed(3)} ${whole}`, ({ left, top }) => {
      const [panorama, place] = [this.#panorama.picture, this.#place].map(({ canvas }) => {
        const box = canvas.getBoundingClientRect();
        return shownIn({ left: box.left - left, top: box.top - top, width: box.width, height: box.height }, canvas.width / canvas.height);
      });
      return linesBetween(matches.points, panorama!, place!, shift);
    });
  }
}
