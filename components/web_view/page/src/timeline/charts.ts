// SPDX-License-Identifier: Apache-2.0
/** Which charts there are, and what each shows. */
import type { Drive, SeriesName } from "../model/drive.ts";
import type { Series } from "../model/series.ts";
import { metres } from "../model/state_line.ts";
import type { Colours } from "../ui/colours.ts";

export interface Curve {
  label: string;
  series: Series;
  colour: keyof Colours;
  dash?: number[];
}

export interface Chart {
  title: string;
  format(value: number): string;
  /** Those that have values. Empty: the chart is not shown. */
  curves(drive: Drive): Curve[];
}

const perSecond = (value: number) => `${value.toFixed(1)} Hz`;
const degreesPerSecond = (value: number) => `${value.toFixed(1)} °/s`;
const whole = (value: number) => String(Math.round(value));
const palette: (keyof Colours)[] = ["enhanced", "binocular", "compass", "landmark", "ink", "soft"];

type Row = [label: string, name: SeriesName, colour: keyof Colours, dash?: number[]];

function of(...rows: Row[]) {
  return (drive: Drive): Curve[] =>
    rows
      .filter(([, name]) => drive.series[name].times.length > 0)
      .map(([label, name, colour, dash]) => ({ label, series: drive.series[name], colour, ...(dash && { dash }) }));
}

const mean = ({ values }: Series) => values.reduce<number>((sum, value) => sum + (value ?? 0), 0) / Math.max(1, values.length);

/** The largest of a group, each component a curve. By their means, so that colours do not change with every value. */
function each(group: (drive: Drive) => Map<string, Series>, least: number) {
  return (drive: Drive): Curve[] =>
    [...group(drive)]
      .map(([label, series]) => ({ label, series, mean: mean(series) }))
      .filter((curve) => curve.mean > least)
      .sort((a, b) => b.mean - a.mean)
      .slice(0, palette.length)
      .map(({ label, series }, i) => ({ label, series, colour: palette[i]! }));
}

export const charts: Chart[] = [
  {
    title: "Position uncertainty",
    format: metres,
    curves: of(
      ["1σ", "sigma", "enhanced"],
      ["protection", "protection", "enhanced", [4, 3]],
      ["error", "error", "ink"],
    ),
  },
  { title: "Turn rate", format: degreesPerSecond, curves: of(["odometry", "odometry", "binocular"], ["compass", "compass", "compass", [3, 3]]) },
  { title: "Features", format: whole, curves: of(["tracked", "tracked", "soft"], ["inliers", "inliers", "enhanced"]) },
  { title: "Speed", format: (value) => `${value.toFixed(1)} m/s`, curves: of(["speed", "speed", "enhanced"]) },
  {
    title: "Rates",
    format: perSecond,
    curves: of(["odometry", "odometryRate", "binocular"], ["pose", "poseRate", "enhanced"], ["panorama", "panoramaRate", "compass"]),
  },
  { title: "Messages dropped", format: whole, curves: each((drive) => drive.dropped, 0) },
  { title: "Latency (p95)", format: (value) => `${value.toFixed(1)} ms`, curves: each((drive) => drive.latency, 0) },
  { title: "CPU", format: (value) => `${Math.round(value)} %`, curves: each((drive) => drive.cpu, 1) },
  { title: "Memory", format: (value) => `${Math.round(value)} MB`, curves: each((drive) => drive.memory, 0) },
];
