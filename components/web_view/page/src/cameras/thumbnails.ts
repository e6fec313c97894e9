// SPDX-License-Identifier: Apache-2.0
import type { Place } from "../model/places.ts";

const most = 50;

/** Pictures of places, decoded when they are first asked for. */
export class Thumbnails {
  #images = new Map<number, { image: HTMLImageElement; of: Uint8Array; isReady: boolean }>();

  constructor(readonly onReady: () => void = () => {}) {}

  get({ id, thumbnail }: Place): HTMLImageElement | undefined {
    if (!thumbnail) return undefined;
    const known = this.#images.get(id);
    if (known && known.of === thumbnail) return known.isReady ? known.image : undefined;
    if (this.#images.size >= most) this.#images.delete(this.#images.keys().next().value!);
    const image = new Image();
    const entry = { image, of: thumbnail, isReady: false };
    image.onload = () => {
      entry.isReady = true;
      URL.revokeObjectURL(image.src);
      this.onReady();
    };
    image.src = URL.createObjectURL(new Blob([thumbnail as Uint8Array<ArrayBuffer>], { type: "image/jpeg" }));
    this.#images.set(id, entry);
    return undefined;
  }
}
