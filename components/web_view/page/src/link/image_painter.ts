// SPDX-License-Identifier: Apache-2.0
/** Decodes image messages to bitmaps, one at a time per topic. While one is decoded, only the newest other one is kept. */
import type { Happening } from "./events.ts";
import { toRgba, type RawImage } from "./pixels.ts";

interface Compressed {
  format: string;
  data: Uint8Array<ArrayBuffer>;
}

type Message = (RawImage | Compressed) & { header: { stamp: { sec: number; nanosec: number }; frame_id: string } };

export class ImagePainter {
  #waiting = new Map<string, Message | undefined>(); // an entry: busy with this topic

  constructor(readonly emit: (happening: Happening, transfer: Transferable[]) => void) {}

  show(topic: string, content: unknown): void {
    const message = content as Message;
    if (this.#waiting.has(topic)) {
      this.#waiting.set(topic, message);
      return;
    }
    this.#waiting.set(topic, undefined);
    void this.#paint(topic, message);
  }

  async #paint(topic: string, message: Message): Promise<void> {
    try {
      const bitmap = await bitmapOf(message);
      const { stamp, frame_id } = message.header;
      this.emit({ kind: "image", topic, frame: frame_id, stamp_s: stamp.sec + stamp.nanosec * 1e-9, bitmap }, [bitmap]);
    } catch (error) {
      this.emit({ kind: "imageFault", topic, why: (error as Error).message }, []);
    }
    const next = this.#waiting.get(topic);
    this.#waiting.delete(topic);
    if (next) this.show(topic, next);
  }
}

function bitmapOf(message: Message): Promise<ImageBitmap> {
  if ("format" in message) {
    return createImageBitmap(new Blob([message.data], { type: message.format.includes("png") ? "image/png" : "image/jpeg" }));
  }
  return createImageBitmap(new ImageData(toRgba(message), message.width, message.height));
}
