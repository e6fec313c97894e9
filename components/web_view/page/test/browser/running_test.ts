// SPDX-License-Identifier: Apache-2.0
/** The page while a system runs: images with their points, and the time line on a phone. */
import assert from "node:assert/strict";
import test, { after, before } from "node:test";
import type { Browser, Page } from "puppeteer-core";
import type { App } from "../../src/app.ts";
import { metres } from "../../src/model/state_line.ts";
import { header, pointCloud } from "../modules/make.ts";
import { launched } from "./browser.ts";
import { image, messages, topics } from "./drive_messages.ts";
import { Publisher } from "./publisher.ts";
import { Server } from "./server.ts";

declare const panvo: App; // in the page

const server = new Server();
let browser: Browser;
let publisher: Publisher;
const first_s = 2000; // stamp of the first image
const green = [0x35, 0xc9, 0x9b, 255]; // of a point that follows the motion

async function opened(width: number, height: number, deviceScaleFactor: number): Promise<Page> {
  const page = await browser.newPage();
  await page.setViewport({ width, height, deviceScaleFactor, hasTouch: true });
  await page.goto(server.url());
  await page.bringToFront(); // a page behind another draws nothing
  await page.waitForFunction((count) => document.body.dataset.link === "open" && panvo.topics.length >= count, { polling: 100 }, Object.keys(topics).length);
  return page;
}

before(async () => {
  await server.start();
  browser = await launched();
  publisher = new Publisher(server.port);
  await publisher.opened();
  await publisher.advertise(topics);
});

after(async () => {
  publisher?.close();
  await browser?.close();
  await server.remove();
});

/** Publishes until the page has it, as it may not be subscribed to yet; for half a minute at most. */
async function publishedUntil(page: Page, publish: () => void, isThere: () => boolean): Promise<void> {
  for (let attempt = 0; attempt < 60; ++attempt) {
    publish();
    const seen = page.waitForFunction(isThere, { polling: 50, timeout: 500 });
    if (await seen.then(() => true, () => false)) return;
  }
  throw new Error(`the page does not have what was published: ${isThere}`);
}

const publishImage = (stamp_s: number, grey: number) => {
  const { width, height } = image;
  const data = new Uint8Array(width * height).fill(grey);
  publisher.publish("/stereo/left/image_rect", { header: header(stamp_s, "left"), width, height, encoding: "mono8", is_bigendian: 0, step: width, data });
};
const publishPoint = (stamp_s: number, u: number) => publisher.publish("/odometry/points", pointCloud(stamp_s, [{ u, v: 40, track: 1, state: 1 }]));

test("an image is seen together with its points, also if they come after it", async () => {
  const page = await opened(1280, 800, 1);
  const pixelsAt = (...us: number[]) =>
    page.$eval(".camera.left canvas", (canvas, columns) => columns.map((u) => [...(canvas as HTMLCanvasElement).getContext("2d")!.getImageData(u, 40, 1, 1).data]), us);
  await publishedUntil(page, () => publishPoint(first_s, 20), () => Number.isFinite(panvo.drive.features.newest));
  await publishedUntil(page, () => publishImage(first_s, 50), () => document.querySelector<HTMLCanvasElement>(".camera.left canvas")!.width === 96);
  assert.deepEqual(await pixelsAt(20, 80), [green, [50, 50, 50, 255]]);
  // The next one has no points yet.
  await page.evaluate(() => {
    const on = panvo.on;
    panvo.on = (happening) => {
      on.call(panvo, happening);
      if (happening.kind === "image") Object.assign(globalThis, { stamp_s: happening.stamp_s });
    };
  });
  publishImage(first_s + 0.5, 200);
  await page.waitForFunction((stamp_s) => (globalThis as unknown as { stamp_s: number }).stamp_s === stamp_s, { polling: 50 }, first_s + 0.5);
  assert.deepEqual(await pixelsAt(20, 80), [green, [50, 50, 50, 255]]);
  publishPoint(first_s + 0.5, 60);
  await page.waitForFunction((stamp_s) => panvo.drive.features.newest === stamp_s, { polling: 50 }, first_s + 0.5);
  assert.deepEqual(await pixelsAt(60, 80), [green, [200, 200, 200, 255]]);
  await page.close();
});

/** Names as long as those of panvo; together they are wider than a phone. */
const components = ["binocular_odometry", "landmark_builder", "panoramic_compass", "position_corrector", "stereo_rectifier"];
const diagnostics = {
  header: header(first_s),
  status: components.map((name, i) => ({
    level: 0, name: `panvo: ${name}`, message: "runs", hardware_id: "none",
    values: [
      { key: "CPU", value: `${10 + i}.0 %` },
      { key: "/slow latency", value: `median 3.00 ms, p95 ${20 + i}.50 ms, max 99.00 ms` },
      { key: "/fast latency", value: "median 1.00 ms, p95 2.00 ms, max 99.00 ms" },
    ],
  })),
};

test("the time line fits a phone, and a finger moves its cursor", async () => {
  const page = await opened(390, 844, 2);
  const drive = [...messages()].filter(([topic]) => topic.startsWith("/odometry/") && topic !== "/odometry/points");
  const publish = () => {
    for (const [topic, message] of drive) publisher.publish(topic, message);
    publisher.publish("/diagnostics", diagnostics);
  };
  await publishedUntil(page, publish, () => panvo.drive.enhanced.count > 100 && panvo.drive.cpu.has("stereo_rectifier"));
  await page.click('.tabs button[data-tab="time"]');
  await page.waitForSelector(".chart:not([hidden]) .u-over");
  const wide = await page.$$eval(".chart:not([hidden]) .u-wrap, .values > span", (all) => all.filter((one) => one.getBoundingClientRect().right > innerWidth).map(({ className, textContent }) => className || textContent));
  assert.deepEqual(wide, []);
  const values = await page.$$eval(".chart:not([hidden])", (all) => all.map((one) => [one.querySelector("b")!.textContent, one.querySelector(".values")!.textContent]));
  const { "Latency (p95)": latency } = Object.fromEntries(values) as Record<string, string>;
  const expected = components.map((name, i) => `${name}${20 + i}.5 ms`).reverse().join("");
  assert.equal(latency!.slice(0, expected.length), expected); // those of the server come after the slower ones

  const box = (await (await page.$(".chart:not([hidden]) .u-over"))!.boundingBox())!;
  const y = box.y + box.height / 2;
  const touch = await page.touchscreen.touchStart(box.x + 0.25 * box.width, y);
  await touch.move(box.x + 0.5 * box.width, y);
  await touch.move(box.x + 0.75 * box.width, y);
  await page.waitForFunction(() => Math.abs((panvo.map.cursor_s! - panvo.drive.begin) / (panvo.drive.now - panvo.drive.begin) - 0.75) < 0.01, { polling: 50, timeout: 20_000 });
  await touch.end();
  await page.close();
});

test("lengths are measured and the vehicle is placed by keys", async () => {
  const page = await opened(1280, 800, 1);
  const { [0]: first } = [...messages()].filter(([topic]) => topic === "/odometry/enhanced");
  await publishedUntil(page, () => publisher.publish(...first!), () => panvo.drive.enhanced.count > 0);
  await page.keyboard.press("m");
  await page.keyboard.press("Enter");
  for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowRight"); // by 60 px each
  await page.keyboard.press("Enter");
  const px_per_m = await page.evaluate(() => panvo.map.view.px_per_m);
  assert.equal(await page.$eval("#hint", (element) => element.textContent), `${metres(180 / px_per_m)} in all`);
  await page.keyboard.press("p");
  await page.keyboard.press("Enter");
  for (const key of ["[", "[", "[", "]"] as const) await page.keyboard.press(key);
  const { x, y } = await page.evaluate(() => panvo.map.view);
  assert.equal(await page.$eval("#confirm-text", (element) => element.textContent), `Place the vehicle at x ${x.toFixed(1)} m, y ${y.toFixed(1)} m, heading 10°?`);
  await page.close();
});

test("a phone shows the meanings from their beginning", async () => {
  const page = await opened(390, 844, 1);
  await page.click('.tabs button[data-tab="system"]');
  await page.click("#help-more");
  const scrolled = await page.$eval("#help", (dialog) => [(dialog as HTMLDialogElement).open, dialog.scrollHeight > dialog.clientHeight, dialog.scrollTop]);
  assert.deepEqual(scrolled, [true, true, 0]);
  await page.close();
});
