// SPDX-License-Identifier: Apache-2.0
/** Pictures that were taken along a drive; the last one until a time is shown. */
export class RecordedPictures {
  #shown = -1;

  /** `pictures`: in order of time, JPEG as base64. */
  constructor(
    readonly pictures: [time: number, jpeg: string][],
    readonly onPicture: (picture: HTMLImageElement, time: number) => void,
  ) {}

  /** Nothing is shown while a newer time asks for another picture. */
  show(time: number): void {
    const index = Math.max(0, this.pictures.filter(([taken]) => taken <= time).length - 1);
    const picture = this.pictures[index];
    if (!picture || index === this.#shown) return;
    this.#shown = index;
    const [taken, jpeg] = picture;
    const image = new Image();
    image.onload = () => index === this.#shown && this.onPicture(image, taken);
    image.src = `data:image/jpeg;base64,${jpeg}`;
  }
}
