// SPDX-License-Identifier: Apache-2.0
/** Measures the page: frames a second with a long drive, and the time from publishing a pose until the page has it. Asserts nothing. */
import test, { after, before } from "node:test";
import type { Browser, Page } from "puppeteer-core";
import type { App } from "../../src/app.ts";
import { launched } from "../browser/browser.ts";
import { messages, topics } from "../browser/drive_messages.ts";
import { Publisher } from "../browser/publisher.ts";
import { Server } from "../browser/server.ts";
import { fill, framesPerSecond } from "./long_drive.ts";

declare const panvo: App; // in the page

const server = new Server();
let browser: Browser;

before(async () => {
  await server.start();
  browser = await launched();
});

after(async () => {
  await browser?.close();
  await server.remove();
});

async function opened(width: number, height: number): Promise<Page> {
  const page = await browser.newPage();
  await page.setViewport({ width, height });
  await page.goto(server.url());
  await page.waitForFunction(() => document.body.dataset.link === "open");
  return page;
}

for (const [width, height] of [[1280, 800], [1920, 1080], [390, 844]] as const) {
  test(`frames at ${width}x${height}, 10,000 poses and 2,000 places`, async (t) => {
    const page = await opened(width, height);
    await page.evaluate(fill, 10_000, 2_000);
    for (const motion of ["all in view", "follow", "zoom", "drag"]) t.diagnostic(`${motion}: ${(await page.evaluate(framesPerSecond, motion)).toFixed(1)} frames/s`);
    await page.close();
  });
}

test("time from publishing a pose until the page has it", async (t) => {
  const page = await opened(1280, 800);
  const publisher = new Publisher(server.port);
  await publisher.opened();
  await publisher.advertise(topics);
  await page.waitForFunction(() => panvo.topics.length >= 9);
  await page.evaluate(() => {
    const ages: number[] = [];
    const take = panvo.drive.take.bind(panvo.drive);
    panvo.drive.take = (one) => {
      const { stamp } = (one.message as { header: { stamp: { sec: number; nanosec: number } } }).header;
      if (one.role === "enhanced") ages.push(Date.now() - stamp.sec * 1000 - stamp.nanosec * 1e-6);
      take(one);
    };
    Object.assign(globalThis, { ages });
  });
  const [, pose] = [...messages()].find(([topic]) => topic === "/odometry/enhanced")! as [string, object];
  for (let i = 0; i < 500; ++i) {
    const now = Date.now();
    publisher.publish("/odometry/enhanced", { ...pose, header: { frame_id: "map", stamp: { sec: Math.floor(now / 1000), nanosec: (now % 1000) * 1e6 } } });
    await new Promise((resolve) => setTimeout(resolve, 40));
  }
  const ages = (await page.evaluate(() => (globalThis as unknown as { ages: number[] }).ages)).sort((a, b) => a - b);
  const quantile = (part: number) => ages[Math.floor(part * (ages.length - 1))]!.toFixed(0);
  t.diagnostic(`${ages.length} poses: median ${quantile(0.5)} ms, p95 ${quantile(0.95)} ms, max ${quantile(1)} ms`);
  publisher.close();
});
