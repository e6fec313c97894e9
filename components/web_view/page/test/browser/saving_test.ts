// SPDX-License-Identifier: Apache-2.0
/** The button that saves the map, in a headless Chromium: it calls the landmark store, and shows its answer. */
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test, { after, before } from "node:test";
import type { Browser, Page } from "puppeteer-core";
import type { App } from "../../src/app.ts";
import { launched } from "./browser.ts";
import { placeMessages } from "./drive_messages.ts";
import { Publisher } from "./publisher.ts";
import { Server } from "./server.ts";

declare const panvo: App; // in the page

const server = new Server();
let browser: Browser;
let page: Page;

before(async () => {
  await server.start({ map: "campus.landmarks" });
  browser = await launched();
  page = await browser.newPage();
  await page.setViewport({ width: 1280, height: 800 });
  await page.goto(server.url());
  await page.click('.side button[data-tab="system"]');
});

after(async () => {
  await browser?.close();
  await server.remove();
});

const shows = (what: string) => page.waitForFunction((text) => document.querySelector("#actions .answer")!.textContent!.startsWith(text), { timeout: 20_000, polling: 100 }, what);
const look = () => page.$$eval("#actions button", (all) => all.map((one) => ({ label: one.textContent, disabled: one.disabled })));

test("a click saves the map of the landmark store, and its answer is shown", async () => {
  await page.waitForSelector("#actions button");
  assert.deepEqual(await look(), [{ label: "Save the map", disabled: false }]);
  await page.click("#actions button");
  await shows("Save the map: refused, no landmarks are stored yet");
  assert.equal(await page.$eval("#actions .answer", (one) => one.getAttribute("aria-live")), "polite");

  const publisher = new Publisher(server.port);
  await publisher.opened();
  await publisher.advertise({ "/landmarks": "panvo_msgs/msg/PanoramicLandmark" });
  const [, landmark] = placeMessages(new Uint8Array([1])).next().value!;
  publisher.publish("/landmarks", { ...(landmark as object), settings: "seed=1", histogram: [1] });
  await page.waitForFunction(() => panvo.drive.places.all.has(7), { timeout: 20_000, polling: 100 });
  const saved = () => fs.readdirSync(server.folder).filter((name) => /^campus_\d{8}T\d{6}Z\.landmarks$/.test(name));
  await page.click("#actions button");
  await shows("Save the map: done, 1 landmarks saved as campus_");
  assert.deepEqual(await page.$eval("#actions .answer", (one) => one.textContent), `Save the map: done, 1 landmarks saved as ${saved()[0]}`);
  assert.equal(fs.existsSync(path.join(server.folder, "campus.landmarks")), true);
  publisher.close();
});

test("the button cannot be pressed while the map is saved, even if services come meanwhile", async () => {
  const save = { name: "/landmark_store/save", type: "std_srvs/srv/Trigger" };
  await page.evaluate((service) => {
    const tells = panvo.on.bind(panvo);
    panvo.on = () => {}; // the server's own list of services
    panvo.send = (order) => {
      if (order.kind === "call") Object.assign(globalThis, { asked: order, tells });
    };
    tells({ kind: "services", services: [service] });
  }, save);
  await page.click("#actions button");
  assert.deepEqual(await look(), [{ label: "Save the map", disabled: true }]);
  await page.evaluate((service) => tells({ kind: "services", services: [service, { ...service, name: "/camera/reset" }] }), save);
  assert.deepEqual(await look(), [{ label: "Save the map", disabled: true }, { label: "camera/reset", disabled: false }]);
  await page.evaluate(() => tells({ kind: "reply", call: asked.call, response: { success: true, message: "5 landmarks saved as a" } }));
  await shows("Save the map: done, 5 landmarks saved as a");
  assert.deepEqual((await look())[0], { label: "Save the map", disabled: false });
  assert.equal(await page.evaluate(() => asked.service), save.name);
  await page.evaluate(() => tells({ kind: "services", services: [] }));
  assert.equal(await page.$eval("#actions", (element) => (element as HTMLElement).hidden), true);
});

declare const asked: Extract<Parameters<App["send"]>[0], { kind: "call" }>;
declare const tells: App["on"];
