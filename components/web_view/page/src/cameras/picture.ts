// SPDX-License-Identifier: Apache-2.0
/** A canvas that shows bitmaps at its own size. */
export class Picture {
  readonly canvas = document.createElement("canvas");
  bitmap: ImageBitmap | HTMLImageElement | undefined;
  #context = this.canvas.getContext("2d", { alpha: false })!;

  /** `shift`: fraction of the width by which the picture is moved to the right, its end coming in from the left. */
  show(bitmap: ImageBitmap | HTMLImageElement, shift = 0): void {
    if (this.bitmap instanceof ImageBitmap && this.bitmap !== bitmap) this.bitmap.close();
    this.bitmap = bitmap;
    const { canvas } = this;
    if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
    }
    const x = Math.round(shift * bitmap.width);
    this.#context.drawImage(bitmap, x, 0);
    if (x > 0) this.#context.drawImage(bitmap, x - bitmap.width, 0);
  }

  /** Draws over the picture. */
  draw(paint: (context: CanvasRenderingContext2D) => void): void {
    paint(this.#context);
  }

  get isEmpty(): boolean {
    return this.bitmap === undefined;
  }
}
