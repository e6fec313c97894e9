// SPDX-License-Identifier: Apache-2.0
/** The thread of the connection: decoding does not make the map stutter. */
import type { Happening, Order } from "./events.ts";
import { ImagePainter } from "./image_painter.ts";
import { Link, type Socket } from "./link.ts";

interface Thread {
  postMessage(happening: Happening, transfer: Transferable[]): void;
  onmessage: ((event: { data: Order }) => void) | null;
}

const thread = self as unknown as Thread;
const emit = (happening: Happening, transfer: Transferable[] = []) => thread.postMessage(happening, transfer);
const painter = new ImagePainter(emit);
const link = new Link({
  connect: (url, protocols) => new WebSocket(url, protocols) as unknown as Socket,
  after: (ms, call) => {
    const timer = setTimeout(call, ms);
    return () => clearTimeout(timer);
  },
  emit,
  showImage: (subscription, message) => painter.show(subscription.channel.topic, message),
});

thread.onmessage = ({ data }) => link.obey(data);
setInterval(() => link.tellTraffic(), 1000);
setInterval(() => link.tellTime(), 200);
