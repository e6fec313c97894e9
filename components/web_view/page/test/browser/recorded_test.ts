// SPDX-License-Identifier: Apache-2.0
/** A page with a recorded drive in it, opened from a file. */
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import test, { after, before } from "node:test";
import type { Browser, Page } from "puppeteer-core";
import type { App } from "../../src/app.ts";
import type { RecordedDrive } from "../../src/model/recorded_drive.ts";
import { inScript } from "../../src/ui/snapshot_file.ts";
import { near } from "../modules/make.ts";
import { recordedStreet } from "../modules/recorded_street.ts";
import { launched } from "./browser.ts";

declare const panvo: App; // in the page

let browser: Browser;
let page: Page;
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "page_recorded_"));

before(async () => {
  browser = await launched();
  page = await browser.newPage();
  await page.setViewport({ width: 1280, height: 800 });
});

after(async () => {
  await browser?.close();
  fs.rmSync(folder, { recursive: true });
});

const textOf = (selector: string) => page.$eval(selector, (element) => (element as HTMLElement).innerText.trim());
const cursor_s = async () => (await page.evaluate(() => panvo.map.cursor_s))!;

/** As `panvo evaluate journey` makes it: the page in one file, with a drive in it. */
function recordedPage(recorded: RecordedDrive): string {
  const [html, style, script] = ["index.html", "style.css", "page.js"].map((name) => fs.readFileSync(path.join("dist", name), "utf8"));
  const data = `<script type="application/json" id="recorded-drive">${JSON.stringify(recorded)}</script>`;
  return html!
    .replace(/<link[^>]*>/g, "")
    .replace("</head>", () => `<style>${style!}</style></head>`)
    .replace(/<script[^>]*><\/script>/, () => `${data}<script>${inScript(script!)}</script>`);
}

/** Pictures of one colour each: red from 0 s, green from 5 s. */
async function colouredPictures(): Promise<[number, string][]> {
  const made = await page.evaluate(() =>
    ["#f00", "#0f0"].map((colour) => {
      const canvas = Object.assign(document.createElement("canvas"), { width: 64, height: 32 });
      const context = canvas.getContext("2d")!;
      context.fillStyle = colour;
      context.fillRect(0, 0, 64, 32);
      return canvas.toDataURL("image/jpeg").split(",")[1]!;
    }),
  );
  return [[0, made[0]!], [5, made[1]!]];
}

/** Waits until both cameras show a picture of one colour: 0: red, 1: green. */
const show = (colour: number) =>
  page.waitForFunction(
    (bright) => {
      const canvases = [...document.querySelectorAll<HTMLCanvasElement>(".camera:not(.place) canvas")].filter(({ width }) => width === 64);
      const pixels = canvases.map((canvas) => [...canvas.getContext("2d")!.getImageData(32, 16, 1, 1).data].slice(0, 3));
      return pixels.length === 2 && pixels.every((pixel) => pixel.every((value, i) => (i === bright ? value > 200 : value < 60)));
    },
    { timeout: 20_000, polling: 100 },
    colour,
  );

test("the cursor moves along a recorded drive, with its pictures and the head of the page", async () => {
  const file = path.join(folder, "drive.html");
  const pictures = await colouredPictures();
  fs.writeFileSync(file, recordedPage({ ...recordedStreet(), pictures: { left: pictures, panorama: pictures } }));
  await page.goto(`file://${file}`);
  assert.equal(await textOf("#link-text"), "Recorded drive");
  assert.equal(await page.$eval("#link", (element) => (element as HTMLElement).title), "a street");
  assert.equal(await textOf("#state-title"), "Position known");
  assert.match(await textOf("#figures"), /True error\s+0\.00 m/i);
  await show(1); // at the end
  const chart = await (await page.$(".chart:not([hidden]) .u-over"))!.boundingBox();
  await page.mouse.move(chart!.x + 0.2 * chart!.width, chart!.y + chart!.height / 2);
  await show(0);
  near(await cursor_s(), 2, 0.2);
  await page.mouse.move(2, 2);
  near(await cursor_s(), 2, 0.2); // it stays
  assert.match(await textOf("#figures"), /True error\s+0\.2\d m/i);
  for (let i = 0; i < 5; ++i) await page.keyboard.press(".");
  await show(1);
  near(await cursor_s(), 7, 0.2);
  const lines = await page.$$eval(".chart:not([hidden]) .u-over", (all) =>
    all.map((over) => (over.querySelector(".u-cursor-x")!.getBoundingClientRect().left - over.getBoundingClientRect().left) / over.clientWidth),
  );
  const { begin, now } = await page.evaluate(() => panvo.drive);
  for (const part of lines) near(part, ((await cursor_s()) - begin) / (now - begin), 0.01);
  assert.equal(await textOf("#state-title"), "Stereo cameras see too little");
  assert.match(await textOf("#state-reason"), /a bus/);
  assert.match(await textOf("#figures"), /True error\s+0\.[67]\d m/i);
});

test("a recorded drive has its report", async () => {
  // It handles keys once it has loaded.
  await page.waitForFunction(() => {
    const report = document.querySelector<HTMLIFrameElement>("#report iframe")!.contentDocument!;
    return report.querySelector("h1") && report.readyState === "complete";
  }, { polling: 100 });
  const isShown = () => page.$eval("#report", (dialog) => (dialog as HTMLDialogElement).open);
  await page.click("#report-button");
  const report = await (await page.$("#report iframe"))!.contentFrame();
  assert.equal(await report.$eval("h1", (element) => element.innerText), "Error after 10 m");
  assert.equal(await isShown(), true);
  await page.click("#report-close");
  assert.equal(await isShown(), false);
  await page.keyboard.press("r");
  assert.equal(await isShown(), true);
  await page.click("#report iframe");
  await page.keyboard.press("Escape");
  assert.equal(await isShown(), false);
});
