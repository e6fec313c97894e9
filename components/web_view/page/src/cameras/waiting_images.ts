// SPDX-License-Identifier: Apache-2.0
/** Images that wait for the points that the odometry finds in them, so that the points are seen in each image and not only at times. */
import type { Happening } from "../link/events.ts";
import type { FeatureTrails } from "../model/features.ts";

export type ImageHappening = Extract<Happening, { kind: "image" }>;

const silence_s = 1; // after so long without points, none are expected
const most = 5; // images; 0.2 s at 25 Hz

export class WaitingImages {
  #images: ImageHappening[] = []; // oldest first

  /** Returns the image that is to be shown now, if there is one: it has its points, or they are not expected any more. */
  add(image: ImageHappening, features: Pick<FeatureTrails, "newest">): ImageHappening | undefined {
    const wait_s = image.stamp_s - features.newest;
    if (!(wait_s > 0 && wait_s < silence_s)) {
      this.clear();
      return image;
    }
    this.#images.push(image);
    return this.#images.length > most ? this.#images.shift() : undefined;
  }

  /** The newest image that is not newer than points of this time. */
  take(time: number): ImageHappening | undefined {
    let due: ImageHappening | undefined;
    while (this.#images.length > 0 && this.#images[0]!.stamp_s <= time) {
      due?.bitmap.close();
      due = this.#images.shift();
    }
    return due;
  }

  clear(): void {
    for (const { bitmap } of this.#images.splice(0)) bitmap.close();
  }
}
