// SPDX-License-Identifier: Apache-2.0
/** Raw images of sensor_msgs/Image as RGBA. */

export interface RawImage {
  width: number;
  height: number;
  encoding: string;
  is_bigendian: number;
  step: number;
  data: Uint8Array;
}

interface Layout {
  bytes: number; // per pixel
  red: number; // offsets of the channels; for 16 bits, of the more significant byte
  green: number;
  blue: number;
}

const layouts: Record<string, Layout> = {
  mono8: { bytes: 1, red: 0, green: 0, blue: 0 },
  "8UC1": { bytes: 1, red: 0, green: 0, blue: 0 },
  mono16: { bytes: 2, red: 1, green: 1, blue: 1 },
  rgb8: { bytes: 3, red: 0, green: 1, blue: 2 },
  bgr8: { bytes: 3, red: 2, green: 1, blue: 0 },
  "8UC3": { bytes: 3, red: 2, green: 1, blue: 0 },
  rgba8: { bytes: 4, red: 0, green: 1, blue: 2 },
  bgra8: { bytes: 4, red: 2, green: 1, blue: 0 },
};

/** Throws for encodings that are not in the table, and for images with fewer bytes than they say. */
export function toRgba(image: RawImage): Uint8ClampedArray<ArrayBuffer> {
  const layout = layouts[image.encoding];
  if (!layout) throw new Error(`images of encoding ${image.encoding} cannot be shown`);
  const { width, height, data } = image;
  const step = image.step || width * layout.bytes;
  if (step < width * layout.bytes || (height > 0 && data.length < (height - 1) * step + width * layout.bytes))
    throw new Error("the image has fewer bytes than its size needs");
  const shift = layout.bytes === 2 && image.is_bigendian ? -1 : 0;
  const red = layout.red + shift;
  const green = layout.green + shift;
  const blue = layout.blue + shift;
  const pixels = new Uint8ClampedArray(width * height * 4);
  for (let row = 0, to = 0; row < height; ++row) {
    for (let column = 0, from = row * step; column < width; ++column, from += layout.bytes, to += 4) {
      pixels[to] = data[from + red]!;
      pixels[to + 1] = data[from + green]!;
      pixels[to + 2] = data[from + blue]!;
      pixels[to + 3] = 255;
    }
  }
  return pixels;
}
