// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import fs from "node:fs";
import test from "node:test";

/** Of sRGB, as in the Web Content Accessibility Guidelines. */
function luminance(hex: string): number {
  const [red, green, blue] = [1, 3, 5].map((at) => {
    const value = Number.parseInt(hex.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  }) as [number, number, number];
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

function contrast(one: string, other: string): number {
  const [dark, light] = [luminance(one), luminance(other)].sort((a, b) => a - b) as [number, number];
  return (light + 0.05) / (dark + 0.05);
}

/** What the guidelines ask of text, and of lines and marks. */
const least = { ink: 4.5, soft: 4.5, truth: 3, binocular: 3, enhanced: 3, compass: 3, good: 3, caution: 3, bad: 3, idle: 3 };

test("texts and lines can be told from the ground, in light and dark", () => {
  const schemes = fs.readFileSync("styles/colours.css", "utf8").split("@media");
  assert.equal(schemes.length, 2);
  for (const scheme of schemes) {
    const colours = Object.fromEntries([...scheme.matchAll(/--([\w-]+): (#[0-9a-f]{6})/g)].map(([, name, value]) => [name, value!]));
    const faint = Object.entries(least).filter(([name, ratio]) => contrast(colours[name]!, colours.card!) < ratio);
    assert.deepEqual(faint, []);
  }
});
