// SPDX-License-Identifier: Apache-2.0
/** A page whose address has the token: the browser gets its other files by the cookie. */
import assert from "node:assert/strict";
import test, { after } from "node:test";
import type { Browser } from "puppeteer-core";
import { launched } from "./browser.ts";
import { Server } from "./server.ts";

let browser: Browser;
const server = new Server();

after(async () => {
  await browser?.close();
  await server.remove();
});

test("every file of the page comes, also the manifest of the app", async () => {
  await server.start({ token: "secret" });
  browser = await launched();
  const page = await browser.newPage();
  const refused: string[] = [];
  page.on("response", (response) => {
    if (response.status() >= 400) refused.push(response.url());
  });
  await page.goto(server.url("secret"));
  const devtools = await page.createCDPSession();
  const { data } = await devtools.send("Page.getAppManifest");
  assert.match(data ?? "", /"name": *"panvo/);
  assert.deepEqual(refused, []);
});
