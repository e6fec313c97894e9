// SPDX-License-Identifier: Apache-2.0
// node build.mjs: bundles the page into dist/, with the licences of what is bundled.
import { build } from "esbuild";
import fs from "node:fs";
import path from "node:path";

const result = await build({
  entryPoints: { page: "src/main.ts", worker: "src/link/worker.ts", style: "styles/page.css" },
  outdir: "dist",
  bundle: true,
  minify: true,
  format: "iife",
  target: ["chrome100", "firefox100", "safari15.4"],
  legalComments: "none",
  metafile: true,
  logLevel: "warning",
});

// Each package that went into the bundles, with its licence, as their terms ask for.
const packages = new Set();
for (const input of Object.keys(result.metafile.inputs)) {
  const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
  if (found) packages.add(found[1]);
}
const licences = [...packages].sort().map((name) => {
  const folder = path.join("node_modules", name);
  const { version, license } = JSON.parse(fs.readFileSync(path.join(folder, "package.json"), "utf8"));
  const file = fs.readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  return `${name} ${version} (${license})\n\n${file ? fs.readFileSync(path.join(folder, file), "utf8") : ""}`;
});
fs.writeFileSync("dist/licences.txt", licences.join("\n\n----\n\n"));
for (const file of ["index.html", "icon.svg", "manifest.webmanifest"]) fs.copyFileSync(file, `dist/${file}`);
