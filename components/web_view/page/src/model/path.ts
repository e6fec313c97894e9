// SPDX-License-Identifier: Apache-2.0
import { wrapped, type Pose2 } from "./geometry.ts";

export interface Bounds {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

export const nowhere = (): Bounds => ({ left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity });

export function widen(bounds: Bounds, x: number, y: number): void {
  bounds.left = Math.min(bounds.left, x);
  bounds.right = Math.max(bounds.right, x);
  bounds.bottom = Math.min(bounds.bottom, y);
  bounds.top = Math.max(bounds.top, y);
}

let revisions = 0; // of all paths, so that no two have the same

/** Poses in order of time, in arrays that grow. When it is full, every other pose is left out. */
export class Path {
  static readonly chunk = 256; // poses with common bounds

  count = 0;
  revision = ++revisions; // changes when poses are removed
  received = 0; // poses added, whether or not they are still kept
  times = new Float64Array(1024);
  xs = new Float64Array(1024);
  ys = new Float64Array(1024);
  yaws = new Float64Array(1024);
  chunks: Bounds[] = [];

  constructor(readonly most = 200_000) {}

  add(time: number, { x, y, yaw }: Pose2): void {
    ++this.received;
    if (this.count === this.most) this.#thin();
    if (this.count === this.xs.length) this.#grow();
    const at = this.count++;
    this.times[at] = time;
    this.xs[at] = x;
    this.ys[at] = y;
    this.yaws[at] = yaw;
    if (at % Path.chunk === 0) this.chunks.push(nowhere());
    widen(this.chunks[this.chunks.length - 1]!, x, y);
  }

  clear(): void {
    this.revision = ++revisions;
    this.count = this.received = 0;
    this.chunks = [];
  }

  /** Removes the poses from `time` on. */
  cut(time: number): void {
    const count = this.indexAt(time - 1e-6) + 1;
    if (count === this.count) return;
    this.revision = ++revisions;
    this.count = count;
    this.chunks.length = Math.ceil(count / Path.chunk);
    const begin = (this.chunks.length - 1) * Path.chunk;
    if (count === 0) return;
    const bounds = (this.chunks[this.chunks.length - 1] = nowhere());
    for (let i = begin; i < count; ++i) widen(bounds, this.xs[i]!, this.ys[i]!);
  }

  at(index: number): Pose2 {
    return { x: this.xs[index]!, y: this.ys[index]!, yaw: this.yaws[index]! };
  }

  get last(): Pose2 | undefined {
    return this.count > 0 ? this.at(this.count - 1) : undefined;
  }

  /** Index of the last pose that is not after `time`; -1: none. */
  indexAt(time: number): number {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle]! <= time) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  /** The pose whose stamp is `time`, to a millisecond. */
  exactly(time: number): Pose2 | undefined {
    const index = this.indexAt(time + 1e-3);
    return index >= 0 && Math.abs(this.times[index]! - time) < 2e-3 ? this.at(index) : undefined;
  }

  /** The pose at `time`, between two poses that are at most `most_s` apart. */
  between(time: number, most_s: number): Pose2 | undefined {
    const before = this.indexAt(time + 1e-6);
    if (before < 0 || (before + 1 === this.count && time > this.times[before]! + 1e-3)) return undefined;
    const after = Math.min(before + 1, this.count - 1);
    const gap = this.times[after]! - this.times[before]!;
    if (gap > most_s) return undefined;
    const part = gap > 0 ? Math.max(0, (time - this.times[before]!) / gap) : 0;
    const [from, to] = [this.at(before), this.at(after)];
    const along = (a: number, b: number) => a + part * (b - a);
    return { x: along(from.x, to.x), y: along(from.y, to.y), yaw: wrapped(from.yaw + part * wrapped(to.yaw - from.yaw)) };
  }

  bounds(): Bounds {
    const bounds = nowhere();
    for (const chunk of this.chunks) {
      widen(bounds, chunk.left, chunk.bottom);
      widen(bounds, chunk.right, chunk.top);
    }
    return bounds;
  }

  #grow(): void {
    for (const key of ["times", "xs", "ys", "yaws"] as const) {
      const longer = new Float64Array(2 * this[key].length);
      longer.set(this[key]);
      this[key] = longer;
    }
  }

  #thin(): void {
    const half = this.count >> 1;
    const received = this.received;
    const poses = Array.from({ length: half }, (_, i) => [this.times[2 * i]!, this.at(2 * i)] as const);
    this.clear();
    for (const [time, pose] of poses) this.add(time, pose);
    this.received = received;
  }
}
