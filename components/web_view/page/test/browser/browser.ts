// SPDX-License-Identifier: Apache-2.0
import puppeteer, { type Browser } from "puppeteer-core";

/** A headless Chromium without its sandbox, which root may not use. */
export const launched = (): Promise<Browser> =>
  puppeteer.launch({ executablePath: process.env.CHROMIUM!, headless: true, args: ["--no-sandbox", "--disable-dev-shm-usage"] }); // containers have little /dev/shm
