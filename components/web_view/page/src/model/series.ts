// SPDX-License-Identifier: Apache-2.0

/** Values over time, s. When it is full, every other value is left out. Bounded, so that the page can stay open for days. */
export class Series {
  times: number[] = [];
  values: (number | null)[] = [];

  constructor(readonly most = 50_000) {}

  add(time: number, value: number): void {
    if (this.times.length >= this.most) {
      this.times = this.times.filter((_, i) => i % 2 === 0);
      this.values = this.values.filter((_, i) => i % 2 === 0);
    }
    this.times.push(time);
    this.values.push(Number.isFinite(value) ? value : null);
  }

  /** Removes the values from `time` on. */
  cut(time: number): void {
    this.times.length = this.values.length = this.indexFrom(time);
  }

  get last(): number | null {
    return this.values[this.values.length - 1] ?? null;
  }

  /** Index of the first value at `time` or later. */
  indexFrom(time: number): number {
    let low = 0;
    let high = this.times.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle]! < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}

/** Values of [from, to] with at most `most` points: of each bin the largest, so that peaks stay. */
export function thinned(series: Series, from: number, to: number, most: number): { times: number[]; values: (number | null)[] } {
  const begin = Math.max(0, series.indexFrom(from) - 1);
  const end = Math.min(series.times.length, series.indexFrom(to) + 1);
  const step = Math.max(1, Math.ceil((end - begin) / most));
  // Bins begin at multiples of the step, so that the curve does not flicker while it grows.
  const times: number[] = [];
  const values: (number | null)[] = [];
  for (let bin = begin - (begin % step); bin < end; bin += step) {
    let best = Math.max(bin, begin);
    for (let i = best + 1; i < Math.min(bin + step, end); ++i) {
      if (Math.abs(series.values[i] ?? 0) > Math.abs(series.values[best] ?? 0)) best = i;
    }
    times.push(series.times[best]!);
    values.push(series.values[best]!);
  }
  return { times, values };
}
