// SPDX-License-Identifier: Apache-2.0
// node test/run.mjs modules|browser|figures: compiles and runs the tests of one kind with node's own test runner.
import { spawnSync } from "node:child_process";
import fs from "node:fs";
import { build } from "esbuild";

const kind = process.argv[2];
const folder = `test/${kind}`;
const entryPoints = fs.readdirSync(folder).filter((name) => name.endsWith("_test.ts")).map((name) => `${folder}/${name}`);
const outdir = `compiled_tests/${kind}`;
fs.rmSync(outdir, { recursive: true, force: true });
await build({ entryPoints, outdir, bundle: true, platform: "node", format: "esm", packages: "external", outExtension: { ".js": ".mjs" }, sourcemap: "inline", logLevel: "warning" });
const files = fs.readdirSync(outdir).map((name) => `${outdir}/${name}`);
const { status } = spawnSync(process.execPath, ["--enable-source-maps", "--test", ...files], { stdio: "inherit" });
process.exit(status ?? 1);
