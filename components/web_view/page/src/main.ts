// SPDX-License-Identifier: Apache-2.0
import { App } from "./app.ts";
import type { Happening, Order } from "./link/events.ts";
import { byId } from "./ui/dom.ts";
import { listenForShortcuts } from "./ui/shortcuts.ts";
import { includedDrive, includedSnapshot } from "./ui/snapshot_file.ts";

const app = new App();
const snapshot = includedSnapshot();
const recorded = includedDrive();
const help = byId<HTMLDialogElement>("help");

if (snapshot) {
  app.show(snapshot);
} else if (recorded) {
  app.showRecorded(recorded);
} else {
  const worker = new Worker("worker.js");
  worker.onmessage = ({ data }: { data: Happening }) => app.on(data);
  app.send = (order: Order) => worker.postMessage(order);
  app.connection.open();
}

byId("snapshot-button").onclick = () => void app.takeSnapshot();
byId("help-button").onclick = byId("help-more").onclick = () => help.showModal();
byId("help-close").onclick = () => help.close();
byId("report-button").onclick = () => app.report.open();
byId("report-close").onclick = () => app.report.close();
listenForShortcuts({
  f: () => app.map.follow(!app.map.follows),
  a: () => app.map.fit(),
  m: () => app.mapPanel.toggleMeasure(),
  p: () => app.mapPanel.togglePlace(),
  s: () => void app.takeSnapshot(),
  r: () => app.report.open(),
  " ": () => void app.player.toggle(),
  ",": () => app.jump(-1),
  ".": () => app.jump(1),
  "<": () => app.player.faster(-1),
  ">": () => app.player.faster(1),
  "?": () => help.showModal(),
  Escape: () => app.mapPanel.cancel(),
});

const frame = () => {
  app.frame();
  requestAnimationFrame(frame);
};
frame();
setInterval(() => app.update(), 200);

// For tests and for curious people in the browser's console.
Object.assign(globalThis, { panvo: app });
