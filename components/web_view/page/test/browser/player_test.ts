// SPDX-License-Identifier: Apache-2.0
/** The controls of a bag, in a headless Chromium: what they ask of the player, by keys and on a phone. */
import assert from "node:assert/strict";
import test, { after, before } from "node:test";
import type { Browser, Page } from "puppeteer-core";
import type { App } from "../../src/app.ts";
import { launched } from "./browser.ts";
import { Server } from "./server.ts";

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
  await page.bringToFront(); // a page behind another gets no keys and draws nothing
  await page.waitForFunction(() => document.body.dataset.link === "open", { polling: 100 });
  return page;
}

const becomes = (page: Page, state: string) => page.waitForFunction((text) => document.querySelector("#player .state")?.textContent === text, { polling: 100 }, state);

/** Acts as a player whose bag is at 100 s, and notes what the page asks of it. Without `isOffered`, its services do not come yet. */
function actAsPlayer(isOffered = true): void {
  const tells = panvo.on.bind(panvo);
  const offered = ["Pause", "TogglePaused", "IsPaused", "GetRate", "SetRate", "Seek"].map((type) => ({
    name: `/rosbag2_player/${type.replace(/\B[A-Z]/g, "_$&").toLowerCase()}`,
    type: `rosbag2_interfaces/srv/${type}`,
  }));
  const player = { paused: false, rate: 1, asked: [] as string[], tells, offered };
  Object.assign(globalThis, { player });
  panvo.on = () => {}; // the server's own list of services may still be on its way, and has no player
  panvo.send = (order) => {
    if (order.kind !== "call") return;
    const name = order.service.replace("/rosbag2_player/", "");
    const { time, rate } = order.request as { time?: { sec: number; nanosec: number }; rate?: number };
    if (!/^(is_|get_)/.test(name)) player.asked.push(`${name}${time ? ` ${time.sec + time.nanosec * 1e-9}` : ""}${rate ? ` ${rate}` : ""}`);
    if (name === "toggle_paused") player.paused = !player.paused;
    if (rate) player.rate = rate;
    queueMicrotask(() => tells({ kind: "reply", call: order.call, response: player }));
  };
  if (isOffered) tells({ kind: "services", services: offered });
  for (const time_s of [90, 120, 100]) tells({ kind: "time", time_s });
}
declare const player: { asked: string[]; tells: App["on"]; offered: { name: string; type: string }[] };

for (const [name, width, height] of [["computer", 1280, 800], ["phone", 390, 844]] as const) {
  test(`a bag is paused, moved and played faster by keys and buttons with names, on a ${name}`, async () => {
    const page = await opened(width, height);
    if (name === "phone") await page.click('.tabs button[data-tab="time"]');
    await page.evaluate(() => (document.activeElement as HTMLElement).blur()); // the space bar would press the button
    await page.evaluate(actAsPlayer);
    await becomes(page, "playing");
    const press = async (key: string, asked: string) => {
      await page.keyboard.press(key as "a");
      await page.waitForFunction((what) => player.asked.at(-1) === what, { polling: 100 }, asked);
    };
    await press("Space", "toggle_paused");
    await becomes(page, "paused");
    await press(".", "seek 110");
    await press(".", "seek 120"); // from where it was moved to, although the server has not told that time yet
    await press(",", "seek 110");
    await press(">", "set_rate 2");
    await press("<", "set_rate 1");
    await page.focus('#player [aria-label="Position in what was played"]');
    await press("Home", "seek 90");
    await page.evaluate(() => (document.activeElement as HTMLElement).blur());
    await press(",", "seek 80"); // before the page was opened
    await page.evaluate(() => player.tells({ kind: "time", time_s: 85 })); // where the bag begins
    await page.waitForFunction(() => document.querySelector("#player input")!.getAttribute("aria-valuetext") === "0:00 of 0:35", { polling: 100 });
    const names = await page.$$eval("#player > :not(.state)", (all) => all.map((one) => one.getAttribute("aria-label")));
    assert.deepEqual(names, ["10 s back", "Play", "10 s on", "Position in what was played", "Speed"]);
    const small = await page.$$eval("#player button, #player input, #player select", (all) => all.map((one) => one.getBoundingClientRect()).filter((box) => box.width < 24 || box.height < 24 || box.right > innerWidth).length);
    assert.equal(small, 0);
    await page.close();
  });
}

test("the slider spans the whole bag if its time range is known, and seeks stay within it", async () => {
  const page = await opened(1280, 800);
  await page.evaluate(() => panvo.on({ kind: "open", server: "panvo", capabilities: ["services"], isAnotherRun: false, range_s: [50, 150] }));
  await page.evaluate(actAsPlayer);
  await page.waitForFunction(() => document.querySelector("#player input")!.getAttribute("aria-valuetext") === "0:50 of 1:40", { polling: 100 });
  await page.focus('#player [aria-label="Position in what was played"]');
  await page.keyboard.press("End");
  await page.waitForFunction(() => player.asked.at(-1) === "seek 150", { polling: 100 });
  await page.evaluate(() => (document.activeElement as HTMLElement).blur());
  await page.keyboard.press(".");
  await page.waitForFunction(() => player.asked.length === 2, { polling: 100 });
  assert.equal(await page.evaluate(() => player.asked.at(-1)), "seek 150");
  await page.close();
});

test("a recorder is not taken for a player, although it can be paused", async () => {
  const page = await opened(1280, 800);
  await page.evaluate(actAsPlayer, false);
  const seen = await page.evaluate(async () => {
    const called: string[] = [];
    const answers = panvo.send;
    panvo.send = (order) => {
      if (order.kind !== "call") return;
      called.push(order.service);
      if (!order.service.startsWith("/rosbag2_recorder/")) return answers(order);
      queueMicrotask(() => player.tells({ kind: "reply", call: order.call, response: { paused: true } }));
    };
    const recorder = ["Pause", "IsPaused"].map((type, i) => ({ name: `/rosbag2_recorder/${["pause", "is_paused"][i]}`, type: `rosbag2_interfaces/srv/${type}` }));
    const look = async (services: typeof recorder) => {
      player.tells({ kind: "services", services });
      await new Promise((resolve) => setTimeout(resolve)); // after all replies
      panvo.update();
      return { hidden: document.getElementById("player")!.hidden, title: document.getElementById("state-title")!.textContent, asked: called.splice(0) };
    };
    panvo.update();
    const before = document.getElementById("state-title")!.textContent;
    const alone = await look(recorder);
    const seekable = player.offered.filter(({ name }) => name.endsWith("/seek"));
    return { before, alone, seekable: await look([...recorder, ...seekable]), both: await look([...recorder, ...player.offered]) };
  });
  assert.deepEqual(seen.alone, { hidden: true, title: seen.before, asked: [] });
  assert.deepEqual(seen.seekable, { hidden: false, title: seen.before, asked: [] }, "only services that are offered are called");
  assert.deepEqual(seen.both, { hidden: false, title: seen.before, asked: ["/rosbag2_player/is_paused", "/rosbag2_player/get_rate"] });
  await page.close();
});

test("a recorder is paused and goes on", async () => {
  const page = await opened(390, 844);
  await page.click('.tabs button[data-tab="system"]');
  await page.evaluate(actAsPlayer, false);
  await page.evaluate(() => {
    const recorder = { paused: false, asked: [] as string[] };
    panvo.send = (order) => {
      if (order.kind !== "call") return;
      const name = order.service.replace("/robot/rosbag2_recorder/", "");
      if (!/is_paused|get_rate/.test(name)) recorder.asked.push(name);
      if (name === "pause" || name === "resume") recorder.paused = name === "pause";
      queueMicrotask(() => player.tells({ kind: "reply", call: order.call, response: recorder }));
    };
    const names = ["Pause", "Resume", "IsPaused"].map((type) => ({ name: `/robot/rosbag2_recorder/${type.replace(/\B[A-Z]/g, "_$&").toLowerCase()}`, type: `rosbag2_interfaces/srv/${type}` }));
    player.tells({ kind: "services", services: [...player.offered, ...names] }); // beside the player, which is not listed
    Object.assign(globalThis, { recorder });
  });
  const shows = (text: string) => page.waitForFunction((what) => (document.getElementById("recorders") as HTMLElement).innerText.replace(/\s+/g, " ") === what, { polling: 100 }, text);
  await shows("Recording robot/rosbag2_recorder records Pause");
  await page.click("#recorders button");
  await shows("Recording robot/rosbag2_recorder paused Record");
  await page.click("#recorders button");
  await shows("Recording robot/rosbag2_recorder records Pause");
  assert.deepEqual(await page.evaluate(() => (globalThis as unknown as { recorder: { asked: string[] } }).recorder.asked), ["pause", "resume"]);
  await page.evaluate(() => player.tells({ kind: "services", services: player.offered }));
  assert.equal(await page.$eval("#recorders", (element) => (element as HTMLElement).hidden), true);
  await page.close();
});
