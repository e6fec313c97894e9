// SPDX-License-Identifier: Apache-2.0
/** A drive as JSON, for a page that shows it without a server. */
import { seriesNames, type Drive, type SeriesName } from "./drive.ts";
import type { Path } from "./path.ts";
import type { Place } from "./places.ts";
import { Series } from "./series.ts";

type Table = (number | null)[][];

export interface Snapshot {
  version: 1;
  taken: string; // ISO date
  drive: Record<string, unknown>;
  paths: Record<(typeof pathNames)[number], Table>;
  places: (Omit<Place, "thumbnail"> & { thumbnail: string })[];
  series: Record<SeriesName, Table>;
  groups: Record<(typeof groupNames)[number], [string, Table][]>;
  pictures: Record<string, string>; // as data URLs, by camera
  panoramaFrame: string;
}

const pathNames = ["enhanced", "binocular", "truth"] as const;
const groupNames = ["dropped", "latency", "cpu", "memory"] as const;
const plain = [
  "mapFromOdom", "mapFromTruth", "now", "begin", "speed", "ellipse", "corrections", "entries", "states", "state", "integrity", "quality", "match", "recognised",
] as const satisfies readonly (keyof Drive)[];
const digits = 4; // 0.1 mm, 0.1 ms

const short = (value: number | null) => (value === null ? null : Number(value.toFixed(digits)));

function tableOf(path: Path): Table {
  const columns = [path.times, path.xs, path.ys, path.yaws];
  return columns.map((column) => Array.from(column.subarray(0, path.count), short));
}

function fill(path: Path, [times, xs, ys, yaws]: Table): void {
  path.clear();
  times!.forEach((time, i) => path.add(time!, { x: xs![i]!, y: ys![i]!, yaw: yaws![i]! }));
}

const tableOfSeries = ({ times, values }: Series): Table => [times.map(short), values.map(short)];

function fillSeries(series: Series, [times, values]: Table): Series {
  times!.forEach((time, i) => series.add(time!, values![i] ?? NaN));
  return series;
}

export function base64(bytes: Uint8Array): string {
  let text = "";
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(text);
}

export function takeSnapshot(drive: Drive, pictures: Record<string, string>, panoramaFrame: string, taken: Date): Snapshot {
  const of = <Key extends string, Value>(keys: readonly Key[], value: (key: Key) => Value) =>
    Object.fromEntries(keys.map((key) => [key, value(key)])) as Record<Key, Value>;
  return {
    version: 1,
    taken: taken.toISOString(),
    drive: { ...of(plain, (key) => drive[key]), driven_m: drive.driven_m, components: [...drive.components], yawOfFrame: [...drive.yawOfFrame] },
    paths: of(pathNames, (name) => tableOf(drive[name])),
    places: [...drive.places.all.values()].map((place) => ({ ...place, thumbnail: place.thumbnail ? base64(place.thumbnail) : "" })),
    series: of(seriesNames, (name) => tableOfSeries(drive.series[name])),
    groups: of(groupNames, (name) => [...drive[name]].map(([key, series]): [string, Table] => [key, tableOfSeries(series)])),
    pictures,
    panoramaFrame,
  };
}

export function restoreSnapshot(drive: Drive, snapshot: Snapshot): void {
  const { driven_m, components, yawOfFrame, ...rest } = snapshot.drive as { driven_m: number; components: []; yawOfFrame: [] };
  for (const name of pathNames) fill(drive[name], snapshot.paths[name]);
  Object.assign(drive, rest, { components: new Map(components), yawOfFrame: new Map(yawOfFrame) });
  drive.restoreDriven(driven_m);
  for (const { thumbnail, ...place } of snapshot.places) {
    const bytes = thumbnail === "" ? undefined : Uint8Array.from(atob(thumbnail), (letter) => letter.charCodeAt(0));
    ++drive.places.version;
    drive.places.all.set(place.id, { ...place, built_s: place.built_s ?? NaN, thumbnail: bytes });
  }
  for (const name of seriesNames) fillSeries(drive.series[name], snapshot.series[name]);
  for (const name of groupNames) for (const [key, table] of snapshot.groups[name]) drive[name].set(key, fillSeries(new Series(), table));
  ++drive.version;
}
