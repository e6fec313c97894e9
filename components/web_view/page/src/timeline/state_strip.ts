// SPDX-License-Identifier: Apache-2.0
/** The state over time, as a band. The worse, the higher, so that it can be read without colours. */
import type { Drive } from "../model/drive.ts";
import { levelOfState } from "../model/happenings.ts";
import { Outcome } from "../model/messages.ts";
import type { Level } from "../model/state_line.ts";
import type { Colours } from "../ui/colours.ts";

const heights: Record<Level, number> = { idle: 0.2, good: 0.4, caution: 0.7, bad: 1 };

export interface Span {
  from: number;
  to: number;
  level: Level;
}

/** Spans of equal level, until `now`. */
export function spansOf(drive: Pick<Drive, "states">, now: number): Span[] {
  const spans: Span[] = [];
  drive.states.forEach(({ time, state, usable }, i) => {
    const level = levelOfState(state) === "good" && !usable ? "caution" : levelOfState(state);
    const to = drive.states[i + 1]?.time ?? Math.max(now, time);
    const last = spans[spans.length - 1];
    if (last && last.level === level) last.to = to;
    else spans.push({ from: time, to, level });
  });
  return spans;
}

export function drawStrip(canvas: HTMLCanvasElement, drive: Drive, colours: Colours, from: number, to: number): void {
  const { clientWidth, clientHeight } = canvas;
  canvas.width = Math.round(clientWidth * devicePixelRatio);
  canvas.height = Math.round(clientHeight * devicePixelRatio);
  const context = canvas.getContext("2d")!;
  context.scale(devicePixelRatio, devicePixelRatio);
  const scale = clientWidth / Math.max(1e-3, to - from);
  for (const span of spansOf(drive, drive.now)) {
    if (span.to < from || span.from > to) continue;
    const left = Math.max(0, (span.from - from) * scale);
    const right = Math.min(clientWidth, (span.to - from) * scale);
    const height = clientHeight * heights[span.level];
    context.fillStyle = colours[span.level];
    context.fillRect(left, clientHeight - height, Math.max(1, right - left), height);
  }
  // A tick for each correction.
  context.fillStyle = colours.ink;
  for (const { time, outcome } of drive.corrections) {
    if (outcome === Outcome.applied && time >= from && time <= to) context.fillRect((time - from) * scale - 0.75, 0, 1.5, clientHeight);
  }
}
