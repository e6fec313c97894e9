// SPDX-License-Identifier: Apache-2.0
/** The page in a headless Chromium, served by the web view: what it shows is what was published, and clicks do what they say. */
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import test, { after, before } from "node:test";
import type { Browser, Page } from "puppeteer-core";
import type { App } from "../../src/app.ts";
import { near } from "../modules/make.ts";
import { launched } from "./browser.ts";
import { image, messages, placeMessages, placeTopics, point, poseAt, poses, topics } from "./drive_messages.ts";
import { Publisher } from "./publisher.ts";
import { Server } from "./server.ts";

declare const panvo: App; // in the page

const server = new Server();
let browser: Browser;
let page: Page;
let publisher: Publisher;
const requested = new Set<string>();

const textOf = (selector: string, on = page) => on.$eval(selector, (element) => (element as HTMLElement).innerText.trim());
const becomes = (selector: string, text: string, on = page) =>
  on.waitForFunction((where, what) => document.querySelector(where)?.textContent?.includes(what), { timeout: 20_000, polling: 100 }, selector, text);

async function opened(url: string, width = 1280, height = 800): Promise<Page> {
  const made = await browser.newPage();
  made.on("request", (request) => void requested.add(new URL(request.url()).host));
  await made.setViewport({ width, height });
  await made.goto(url);
  return made;
}

/** Closes another page and brings this one to the front: a page in the background gets no keys and draws nothing. */
async function closed(other: Page): Promise<void> {
  await other.close();
  await page.bringToFront();
}

/** Waits until the page knows these topics, and the server has subscribed for it to those that it wants. */
async function subscribed(topics: string[]): Promise<void> {
  await page.waitForFunction((names) => names.every((name) => panvo.topics.some(({ topic }) => topic === name)), { timeout: 20_000, polling: 100 }, topics);
  // The server does what a client asks in order: the answer to a call comes after the subscriptions before it.
  await page.waitForFunction(
    () =>
      new Promise<boolean>((resolve) => {
        const on = panvo.on;
        panvo.on = (happening) => {
          on.call(panvo, happening);
          if (happening.kind !== "reply" || happening.call !== 0) return;
          panvo.on = on;
          resolve(happening.fault === undefined); // the services may not be known yet
        };
        panvo.send({ kind: "call", call: 0, service: "/container/_container/list_nodes", request: {} });
      }),
    { timeout: 20_000, polling: 100 },
  );
}

before(async () => {
  await server.start();
  browser = await launched();
  publisher = new Publisher(server.port);
  await publisher.opened();
  page = await opened(server.url());
  await becomes("#link-text", "Live");
  await publisher.advertise(topics);
  await subscribed(Object.keys(topics));
  for (const [topic, message] of messages()) publisher.publish(topic, message);
  await page.waitForFunction((count) => panvo.drive.enhanced.received === count && panvo.drive.components.has("localizer"), { timeout: 20_000 }, poses);
});

after(async () => {
  publisher?.close();
  await browser?.close();
  await server.remove();
});

test("the state is the one that was published, in words", async () => {
  await becomes("#state-title", "Position known");
  assert.equal(await textOf("#state-reason"), "within 1.37 m at 99.9 % confidence");
  assert.equal(await page.$eval("#state", (element) => (element as HTMLElement).dataset.level), "good");
});

test("poses, places and corrections are those that were published", async () => {
  const shown = await page.evaluate(() => ({
    enhanced: panvo.drive.enhanced.received,
    binocular: panvo.drive.binocular.received,
    pose: panvo.drive.pose,
    drift: panvo.drive.drift_m,
    place: panvo.drive.places.all.get(7)?.pose,
    corrections: panvo.drive.corrections.length,
  }));
  assert.equal(shown.enhanced, poses);
  assert.equal(shown.binocular, poses);
  const last = poseAt(poses - 1);
  near(shown.pose!.x, last.x, 1e-9);
  near(shown.pose!.y, last.y, 1e-9);
  near(shown.pose!.yaw, last.yaw, 1e-9);
  near(shown.drift, 1.5, 1e-9);
  assert.deepEqual([shown.place!.x, shown.place!.y, shown.corrections], [10, 20, 1]);
});

test("the figures in the head are those of the messages", async () => {
  await becomes("#figures", "Driven");
  const figures = await page.$$eval("#figures > div:not([hidden])", (elements) => elements.map((element) => [element.children[0]!.textContent, element.children[1]!.textContent]));
  assert.deepEqual(Object.fromEntries(figures), { Position: "±0.25 m", "Protection level": "1.37 m", "Drift removed": "1.50 m", Speed: "4.0 m/s", Driven: "48.1 m", Time: "0:11" }); // driven: of the odometry
});

test("the image has the colour that was published", async () => {
  await page.waitForFunction((width) => document.querySelector<HTMLCanvasElement>(".camera.left canvas")!.width === width, {}, image.width);
  const pixel = await page.$eval(".camera.left canvas", (canvas) => [...(canvas as HTMLCanvasElement).getContext("2d")!.getImageData(0, 0, 1, 1).data]);
  assert.deepEqual(pixel, [250, 0, 0, 255]);
});

test("the points of the odometry are drawn where they are seen, in the colour of their kind", async () => {
  await becomes(".left .legend .inlier", "1 follow the motion");
  const colours = await page.$eval(
    ".camera.left canvas",
    (canvas, u, v) => [0, 20].map((away) => [...(canvas as HTMLCanvasElement).getContext("2d")!.getImageData(u + away, v, 1, 1).data]),
    point.u,
    point.v,
  );
  assert.deepEqual(colours, [[0x35, 0xc9, 0x9b, 255], [250, 0, 0, 255]]);
});

/** Of the lines between the pictures: `down`: fraction of the way from the one point to the other. */
const lineColour = (u: number, down: number) =>
  page.evaluate(
    (column, part) => {
      const canvas = document.querySelector<HTMLCanvasElement>("canvas.lines")!;
      const [area, above, below] = ["canvas.lines", ".panorama canvas", ".place canvas"].map((one) => document.querySelector(one)!.getBoundingClientRect());
      const y = above!.top + above!.height / 2 + part * (below!.top + below!.height / 2 - above!.top - above!.height / 2) - area!.top;
      const x = above!.left + column * above!.width - area!.left;
      const { data } = canvas.getContext("2d")!.getImageData(Math.round(x) - 1, Math.round(y), 3, 1);
      return [0, 1, 2].map((i) => [...data.subarray(4 * i, 4 * i + 4)]).sort((a, b) => b[3]! - a[3]!)[0]!;
    },
    u,
    down,
  );

test("lines lead from the panorama to the same points of the recognised place, which is turned to the same heading", async () => {
  await publisher.advertise(placeTopics);
  await subscribed(Object.keys(placeTopics));
  const jpeg = await page.evaluate(() => {
    const canvas = Object.assign(document.createElement("canvas"), { width: 64, height: 32 });
    return canvas.toDataURL("image/jpeg").split(",")[1]!;
  });
  for (const [topic, message] of placeMessages(new Uint8Array(Buffer.from(jpeg, "base64")))) publisher.publish(topic, message);
  await becomes(".place .legend .inlier", "1 points agree with the pose");
  await becomes(".place .legend .outlier", "1 contradict it");
  await becomes(".place figcaption", "turned by 90°");
  const [red, green, , alpha] = await lineColour(0.5, 0.5);
  assert.ok(green! > 150 && red! < 90 && alpha! > 100, `${red} ${green} ${alpha}`); // straight down
  assert.equal((await lineColour(0.4, 0.5))[3], 0);
  await page.click(".place button");
  await page.waitForFunction(() => {
    const canvas = document.querySelector<HTMLCanvasElement>("canvas.lines")!;
    return canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height).data.every((value) => value === 0);
  });
  await page.click(".place button"); // on again
});

test("events and components are listed", async () => {
  await page.click('aside button[data-tab="events"]');
  await becomes(".events", "Place 7 recognised");
  await page.click('aside button[data-tab="system"]');
  await becomes(".components", "localizer");
  assert.match(await textOf(".components"), /too slow; 3 dropped in all/);
  await becomes(".facts", "Not decodednothing");
  await page.click('aside button[data-tab="cameras"]');
});

test("parameters are listed with their ranges, and fixed ones cannot be changed", async () => {
  await page.click('aside button[data-tab="system"]');
  await becomes("#parameters", "/web_view");
  await becomes("#parameters", "TCP port; 0: any free one; 0 to 65535; fixed while it runs");
  const fields = await page.$$eval("#parameters input", (inputs) => inputs.map((input) => [input.getAttribute("aria-label"), input.value, input.disabled]));
  assert.ok(fields.some(([label, value, isDisabled]) => label === "max_clients" && value === "8" && isDisabled));
  await page.click('aside button[data-tab="cameras"]');
});

/** Types into a parameter's field, as a user does. */
async function setParameter(field: string, text: string): Promise<void> {
  await page.$eval(field, (input) => (input as HTMLInputElement).select());
  await page.type(field, text);
  await page.keyboard.press("Enter");
  await page.waitForFunction((where) => !document.querySelector(where)!.closest(".parameter")!.classList.contains("waiting"), {}, field);
}

test("a parameter that is set is the component's, and one out of range is refused with the reason", async () => {
  const field = '#parameters input[aria-label="jpeg_quality"]';
  const valueOf = (on: Page) => on.$eval(field, (input) => (input as HTMLInputElement).value);
  await page.click('aside button[data-tab="system"]');
  await page.waitForSelector(field);
  await page.$$eval("#parameters details", (nodes) => nodes.forEach((node) => (node.open = true)));
  await setParameter(field, "40");
  assert.equal(await valueOf(page), "40");
  const other = await opened(server.url());
  await other.waitForSelector(field);
  assert.equal(await valueOf(other), "40");
  await closed(other);
  await setParameter(field, "400");
  assert.equal(await valueOf(page), "40");
  assert.match(await textOf("#note"), /jpeg_quality was not set/);
  await page.click('aside button[data-tab="cameras"]');
});

/** Pixel of the page where a point of the map is seen. */
const pixelOf = (x: number, y: number) =>
  page.evaluate(
    (mx, my) => {
      const { left, top } = panvo.map.canvas.getBoundingClientRect();
      const at = panvo.map.view.toScreen(mx, my);
      return { x: at.x + left, y: at.y + top };
    },
    x,
    y,
  );

/** Of the map, after the next frame. */
const colourAt = (x: number, y: number) =>
  page.evaluate(
    (px, py) =>
      new Promise<number[]>((resolve) =>
        requestAnimationFrame(() =>
          requestAnimationFrame(() => {
            const { canvas } = panvo.map;
            const { left, top } = canvas.getBoundingClientRect();
            resolve([...canvas.getContext("2d")!.getImageData((px - left) * devicePixelRatio, (py - top) * devicePixelRatio, 1, 1).data].slice(0, 3));
          }),
        ),
      ),
    x,
    y,
  );

test("the map draws the vehicle where it is", async () => {
  await page.click("#fit");
  const { x, y } = await pixelOf(poseAt(poses - 1).x, poseAt(poses - 1).y);
  assert.deepEqual(await colourAt(x, y - 2), [0x00, 0x72, 0xb2]); // ahead of the middle of the arrow, which points up
});

test("a line leads from a place to where it was seen again, until its layer is switched off", async () => {
  await page.click("#fit");
  const { x, y } = await pixelOf(20, 25);
  assert.deepEqual(await colourAt(x, y), [0x00, 0x80, 0x5d]);
  const texts = ["Sightings of places", "Corrections"];
  await page.$$eval("#legend label", (labels, those) => labels.forEach((label) => those.includes((label as HTMLElement).innerText) && (label as HTMLElement).click()), texts);
  assert.notDeepEqual(await colourAt(x, y), [0x00, 0x80, 0x5d]);
  await page.$$eval("#legend input:not(:checked)", (boxes) => boxes.forEach((box) => (box as HTMLElement).click()));
});

test("a tap on a place shows it", async () => {
  await page.click("#fit");
  const { x, y } = await pixelOf(10, 20);
  await page.mouse.click(x, y);
  await becomes("#card-title", "Place 7");
  assert.match(await textOf("#card-text"), /corrected the position once/);
  await page.click("#card-close");
  assert.equal(await page.$eval("#card", (card) => (card as HTMLElement).hidden), true);
});

test("the measure has the length of what was tapped", async () => {
  await page.click("#fit");
  await page.click("#measure");
  for (const [x, y] of [[5, 5], [8, 9]] as const) {
    const at = await pixelOf(x, y);
    await page.mouse.click(at.x, at.y);
  }
  const length = Number.parseFloat(await textOf("#hint"));
  near(length, 5, 0.15);
  await page.keyboard.press("Escape");
  assert.equal(await page.$eval("#hint", (hint) => (hint as HTMLElement).hidden), true);
});

test("keys and drags move the map, and end following", async () => {
  await page.keyboard.press("f");
  assert.equal(await page.evaluate(() => panvo.map.follows), true);
  await page.focus("#map-canvas");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await page.$eval("#follow", (button) => button.getAttribute("aria-pressed")), "false");
  const before = await page.evaluate(() => ({ ...panvo.map.view }));
  await page.mouse.move(400, 300);
  await page.mouse.down();
  await page.mouse.move(500, 340, { steps: 5 });
  await page.mouse.up();
  const dragged = await page.evaluate(() => ({ ...panvo.map.view }));
  near((before.x - dragged.x) * before.px_per_m, 100, 7);
  near((dragged.y - before.y) * before.px_per_m, 40, 7);
});

async function drawPose(x: number): Promise<void> {
  await page.click("#fit");
  await page.click("#place");
  const at = await pixelOf(x, 4);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x, at.y + 60, { steps: 5 }); // down: heading -90 degrees
  await page.mouse.up();
  await becomes("#confirm-text", "heading -90°");
}

test("the vehicle is placed where it was drawn, and only after it was confirmed", async () => {
  await drawPose(10);
  await page.click("#place-yes"); // the topic exists from now on
  await publisher.subscribe("/initialpose"); // may be in time for that first pose
  await drawPose(8);
  await page.click("#place-no");
  await drawPose(12);
  await page.click("#place-yes");
  type Pose = { header: { frame_id: string }; pose: { pose: { position: { x: number; y: number }; orientation: { z: number; w: number } } } };
  const later = () => publisher.received.map(({ message }) => message as Pose).filter(({ pose }) => Math.abs(pose.pose.position.x - 10) > 0.5);
  await publisher.until(() => later().length > 0);
  assert.equal(later().length, 1);
  const { header, pose } = later()[0]!;
  assert.equal(header.frame_id, "map");
  near(pose.pose.position.x, 12, 0.1);
  near(pose.pose.position.y, 4, 0.1);
  near(2 * Math.atan2(pose.pose.orientation.z, pose.pose.orientation.w), -Math.PI / 2, 0.01);
});

test("a snapshot is one file that shows the same without a server", async () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "page_snapshot_"));
  const devtools = await page.createCDPSession();
  await devtools.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder, eventsEnabled: true });
  const done = new Promise<void>((resolve) => devtools.on("Browser.downloadProgress", ({ state }) => state === "completed" && resolve()));
  await page.click("#snapshot-button");
  await done;
  const file = path.join(folder, fs.readdirSync(folder)[0]!);
  const copy = await opened(`file://${file}`);
  await becomes("#link-text", "Snapshot of", copy);
  assert.equal(await textOf("#state-title", copy), "Position known");
  const shown = await copy.evaluate(() => [panvo.drive.enhanced.count, panvo.drive.corrections.length, panvo.drive.driven_m]);
  assert.deepEqual(shown.slice(0, 2), [poses, 1]);
  near(shown[2]!, 48.1, 0.1);
  await copy.waitForFunction((width) => document.querySelector<HTMLCanvasElement>(".camera.left canvas")!.width === width, {}, image.width);
  await closed(copy);
  fs.rmSync(folder, { recursive: true });
});

test("on a phone nothing is wider than the screen", async () => {
  const phone = await opened(server.url(), 390, 844);
  await becomes("#link-text", "Live", phone);
  for (const tab of ["map", "cameras", "events", "time", "system"]) {
    await phone.click(`.tabs button[data-tab="${tab}"]`);
    const wide = await phone.evaluate(() => [...document.querySelectorAll("main *, header, .tabs")].filter((element) => element.getBoundingClientRect().right > innerWidth + 1 && !element.closest("#figures, .values, .tape, .u-wrap")).map((element) => element.outerHTML.slice(0, 80)));
    assert.deepEqual(wide, [], tab);
  }
  await closed(phone);
});

test("a server that is lost is shown, and found again when it is back", async () => {
  const { port } = server;
  await server.stop();
  await becomes("#state-title", "Server lost");
  await becomes("#link-text", "again in");
  await server.start({ port });
  await becomes("#link-text", "Live");
});

test("a token is asked for, and opens the connection", async () => {
  const { port } = server;
  await server.stop();
  await server.start({ port, token: "secret" });
  await page.waitForSelector("#connect[open]", { timeout: 20_000 });
  await page.type("#token", "secret");
  await page.click("#connect-form .primary");
  await becomes("#link-text", "Live");
});

test("nothing was asked of another host", () => {
  assert.deepEqual([...requested].filter((host) => host !== "" && host !== `127.0.0.1:${server.port}`), []);
});
