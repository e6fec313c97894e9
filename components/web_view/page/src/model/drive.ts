// SPDX-License-Identifier: Apache-2.0
/** All that the page knows of a drive, from the messages that came. No drawing, no connection. */
import type { RoleMessage } from "../link/events.ts";
import type { Role } from "../link/roles.ts";
import { mapFromFrame } from "./anchor.ts";
import { componentsOf, droppedBy, latencyOf, type Component } from "./components.ts";
import { FeatureTrails, type Features } from "./features.ts";
import { composed, distance, ellipseOf, flat, identity, wrapped, yawOf, type Ellipse, type Pose2 } from "./geometry.ts";
import { correctionOf, entryOfPass, entryOfState, type Correction, type Entry } from "./happenings.ts";
import type { Matches } from "./matches.ts";
import * as m from "./messages.ts";
import { Odometer } from "./odometer.ts";
import { Path } from "./path.ts";
import { Places } from "./places.ts";
import { Rate } from "./rates.ts";
import { Series } from "./series.ts";
import { TurnComparison } from "./turn.ts";

export const seriesNames = [
  "sigma", "protection", "alert", "error", "compass", "odometry", "tracked", "inliers", "speed", "poseRate", "odometryRate", "panoramaRate",
] as const;
export type SeriesName = (typeof seriesNames)[number];

const mostEntries = 500;
const mostCorrections = 5000;
const pass_s = 4; // between two sightings of one pass
const restart_s = 1; // a stamp that lies further back is of a bag that was moved

export class Drive {
  enhanced = new Path();
  binocular = new Path();
  truth = new Path();
  mapFromOdom: Pose2 | undefined; // where the path of the odometry is drawn
  mapFromTruth: Pose2 | undefined;
  now = -Infinity; // stamp of the newest pose, s
  begin = Infinity;
  speed = NaN; // m/s
  ellipse: Ellipse | undefined;
  features = new FeatureTrails();
  places = new Places();
  corrections: Correction[] = []; // the newest
  correctionsTaken = 0; // also those that are not kept
  entries: Entry[] = [];
  states: { time: number; state: number; usable: boolean }[] = [];
  state: m.LocalizationState | undefined;
  integrity: m.Integrity | undefined;
  quality: m.OdometryQuality | undefined;
  match: m.LandmarkMatch | undefined;
  matches: Matches | undefined; // the newest points of a place
  recognised: { place: number; heading: number; time: number } | undefined; // the last one
  components = new Map<string, Component>();
  series = Object.fromEntries(seriesNames.map((name) => [name, new Series()])) as Record<SeriesName, Series>;
  dropped = new Map<string, Series>(); // messages, by component
  latency = new Map<string, Series>();
  cpu = new Map<string, Series>();
  memory = new Map<string, Series>();
  yawOfFrame = new Map<string, number>(); // of a camera's view direction in the vehicle, rad
  version = 0; // changes with the content
  #located_s = -Infinity;
  #odometer = new Odometer();
  #pass: Correction[] = []; // sightings of one place, one after the other
  #passEntry: Entry | undefined;
  #turns = new TurnComparison();
  #rates = new Map<SeriesName, Rate>();

  /** The vehicle in the map; with odometry alone, in its own frame. */
  get pose(): Pose2 | undefined {
    return this.enhanced.last ?? this.binocular.last;
  }

  /** Length of the way, without the jumps of corrections, m. */
  get driven_m(): number {
    return this.#odometer.length_m;
  }

  restoreDriven(length_m: number): void {
    this.#odometer.length_m = length_m;
  }

  /** How far the odometry alone would be off, m. */
  get drift_m(): number {
    const pose = this.enhanced.last;
    const alone = this.binocular.last;
    return pose && alone && this.mapFromOdom ? distance(pose, composed(this.mapFromOdom, alone)) : NaN;
  }

  /** Distance to the ground truth, m. */
  get error_m(): number {
    return this.series.error.last ?? NaN;
  }

  take({ role, message }: RoleMessage): void {
    ++this.version;
    this.#handlers[role](message as never);
  }

  #handlers: Record<Role, (message: never) => void> = {
    enhanced: (message: m.Odometry) => this.#onPose(message),
    binocular: (message: m.Odometry) => this.#onOdometry(message),
    truth: (message: m.Odometry) => this.#onTruth(message),
    quality: (message: m.OdometryQuality) => {
      this.quality = message;
      this.#add("tracked", m.seconds(message.header.stamp), message.tracked);
      this.#add("inliers", m.seconds(message.header.stamp), message.inliers);
    },
    azimuth: (message: m.AzimuthChange) => {
      this.#count("panoramaRate", m.seconds(message.header.stamp));
      this.#turns.add(message);
      this.#compareTurns();
    },
    points: (features: Features | undefined) => features && this.features.add(features),
    landmark: (message: m.Landmark) => this.#onLandmark(message),
    landmarkPoses: (message: m.LandmarkPoses) => this.places.move(message),
    match: (message: m.LandmarkMatch) => this.#onMatch(message),
    matchPoints: (matches: Matches | undefined) => matches && (this.matches = matches),
    outcome: (message: m.CorrectionOutcome) => this.#onOutcome(message),
    state: (message: m.LocalizationState) => this.#onState(message),
    integrity: (message: m.Integrity) => this.#onIntegrity(message),
    pathEnhanced: (message: m.PathMessage) => this.#onHistory(this.enhanced, message),
    pathBinocular: (message: m.PathMessage) => this.#onHistory(this.binocular, message),
    diagnostics: (message: m.DiagnosticArray) => this.#onDiagnostics(message),
    transforms: (message: m.Transforms) => {
      for (const { child_frame_id, transform } of message.transforms) {
        const { x, y, z, w } = transform.rotation;
        // Direction of the camera's z axis in the plane.
        this.yawOfFrame.set(child_frame_id, Math.atan2(2 * (y * z - w * x), 2 * (x * z + w * y)));
      }
    },
  };

  #onPose({ header, pose, twist }: m.Odometry): void {
    const time = m.seconds(header.stamp);
    if (time < this.now - restart_s) this.#goBack(time);
    this.begin = Math.min(this.begin, time);
    this.now = Math.max(this.now, time);
    this.enhanced.add(time, flat(pose.pose));
    this.ellipse = ellipseOf(pose.covariance);
    if (this.ellipse) this.#add("sigma", time, this.ellipse.major);
    this.speed = Math.hypot(twist.twist.linear.x, twist.twist.linear.y);
    this.#add("speed", time, this.speed);
    this.#count("poseRate", time);
    this.#align();
    this.#compareWithTruth(time);
  }

  #onOdometry({ header, pose, twist }: m.Odometry): void {
    const time = m.seconds(header.stamp);
    const last = this.binocular.count > 0 ? this.binocular.times[this.binocular.count - 1]! : -Infinity;
    if (time < last - restart_s) this.#goBack(time);
    this.binocular.add(time, flat(pose.pose));
    this.#odometer.add(this.binocular.last!);
    this.#count("odometryRate", time);
    this.#compareTurns();
    if (this.enhanced.count > 0) return;
    this.begin = Math.min(this.begin, time);
    this.now = Math.max(this.now, time);
    this.ellipse = ellipseOf(pose.covariance);
    if (this.ellipse) this.#add("sigma", time, this.ellipse.major);
    this.speed = Math.hypot(twist.twist.linear.x, twist.twist.linear.y);
  }

  #onTruth({ header, pose }: m.Odometry): void {
    const time = m.seconds(header.stamp);
    this.truth.add(time, flat(pose.pose));
    this.#align();
    if (Math.abs(time - this.now) < 1e-3) this.#compareWithTruth(time);
  }

  #onLandmark(message: m.Landmark): void {
    const place = this.places.add(message);
    const isOfThisDrive = place.built_s >= this.begin;
    if (isOfThisDrive) this.#enter({ time: place.built_s, level: "idle", text: `Place ${place.id} remembered`, detail: place.isJunction ? "a junction" : "no other place near", at: place.pose });
  }

  #onMatch(message: m.LandmarkMatch): void {
    this.match = message;
    if (message.state === m.Match.locked || message.state === m.Match.matched)
      this.recognised = { place: message.landmark_id, heading: message.heading_rad, time: m.seconds(message.header.stamp) };
  }

  #onOutcome(message: m.CorrectionOutcome): void {
    const correction = correctionOf(message, m.seconds(message.header.stamp));
    this.corrections.push(correction);
    ++this.correctionsTaken;
    if (this.corrections.length > mostCorrections) this.corrections.shift();
    const place = this.places.all.get(correction.place);
    if (place && correction.outcome === m.Outcome.applied) {
      ++place.corrections;
      this.recognised = { place: place.id, heading: wrapped(correction.after.yaw - place.pose.yaw), time: correction.time };
    }
    this.#enterCorrection(correction);
  }

  #onState(message: m.LocalizationState): void {
    const time = Math.max(m.seconds(message.header.stamp), this.states[this.states.length - 1]?.time ?? -Infinity);
    const before = this.state;
    this.state = message;
    if (before?.state === message.state && before.reason === message.reason) return;
    if (before?.state === m.State.unlocated) this.#forgetAlignment(time);
    if (before?.state !== message.state) this.#enter(entryOfState(message.state, message.reason, time, this.pose));
    this.#noteState(time);
  }

  #onIntegrity(message: m.Integrity): void {
    const time = m.seconds(message.header.stamp);
    const wasUsable = this.integrity?.usable;
    this.integrity = message;
    this.#add("protection", time, message.horizontal_protection_level_m);
    this.#add("alert", time, message.alert_limit_m);
    if (wasUsable === message.usable) return;
    this.#noteState(time);
    if (wasUsable === undefined && message.usable) return;
    this.#enter({
      time,
      level: message.usable ? "good" : "caution",
      text: message.usable ? "Position usable again" : "Do not rely on the position",
      detail: message.usable ? "" : message.reason,
      at: this.pose,
    });
  }

  #onDiagnostics(message: m.DiagnosticArray): void {
    const time = Number.isFinite(this.now) ? this.now : m.seconds(message.header.stamp);
    const add = (series: Map<string, Series>, name: string, value: number | undefined) => {
      if (value === undefined) return;
      if (!series.has(name)) series.set(name, new Series(5000));
      series.get(name)!.add(time, value);
    };
    for (const component of componentsOf(message)) {
      this.components.set(component.name, component);
      if (component.inputs.length > 0) add(this.dropped, component.name, droppedBy(component));
      add(this.latency, component.name, latencyOf(component));
      add(this.cpu, component.name, component.cpu_percent);
      add(this.memory, component.name, component.memory_mb);
    }
  }

  /** The poses before the page was opened. */
  #onHistory(path: Path, { poses }: m.PathMessage): void {
    const first = path.count > 0 ? path.times[0]! : Infinity;
    const kept = Array.from({ length: path.count }, (_, i) => [path.times[i]!, path.at(i)] as const);
    const received = path.received;
    path.clear();
    for (const { header, pose } of poses) {
      const time = m.seconds(header.stamp);
      if (time < first - 1e-3) path.add(time, { x: pose.position.x, y: pose.position.y, yaw: yawOf(pose.orientation) });
    }
    for (const [time, pose] of kept) path.add(time, pose);
    path.received = received + path.count - kept.length;
    if (path === this.binocular) this.#odometer = Odometer.of(path);
    if (path.count > 0) this.begin = Math.min(this.begin, path.times[0]!);
    this.#forgetAlignment(-Infinity);
    this.#align();
  }

  #forgetAlignment(located_s: number): void {
    this.#located_s = located_s;
    this.mapFromOdom = this.mapFromTruth = undefined;
  }

  #align(): void {
    this.mapFromOdom ??= mapFromFrame(this.enhanced, this.binocular, this.#located_s);
    this.mapFromTruth ??= mapFromFrame(this.enhanced, this.truth, this.#located_s);
  }

  #compareWithTruth(time: number): void {
    const truth = this.mapFromTruth && this.truth.exactly(time);
    const pose = this.enhanced.last;
    if (truth && pose) this.#add("error", time, distance(pose, composed(this.mapFromTruth ?? identity, truth)));
  }

  #compareTurns(): void {
    for (const { time, compass, odometry } of this.#turns.take(this.binocular)) {
      this.#add("compass", time, compass);
      this.#add("odometry", time, odometry);
    }
  }

  #noteState(time: number): void {
    this.states.push({ time, state: this.state?.state ?? 0, usable: this.integrity?.usable ?? true });
  }

  #enterCorrection(correction: Correction): void {
    const last = this.#pass[this.#pass.length - 1];
    const goesOn = last?.place === correction.place && correction.time - last.time < pass_s && this.entries.at(-1) === this.#passEntry;
    if (goesOn) this.entries.pop();
    this.#pass = goesOn ? [...this.#pass, correction] : [correction];
    this.#enter((this.#passEntry = entryOfPass(this.#pass)));
  }

  #enter(entry: Entry): void {
    this.entries.push(entry);
    if (this.entries.length > mostEntries) this.entries.shift();
  }

  #add(name: SeriesName, time: number, value: number): void {
    this.series[name].add(time, value);
  }

  #count(name: SeriesName, time: number): void {
    if (!this.#rates.has(name)) this.#rates.set(name, new Rate());
    const rate = this.#rates.get(name)!.add(time);
    if (rate !== undefined) this.#add(name, time, rate);
  }

  /** The time went back: a bag was moved, or started again. What lies before stays. */
  #goBack(time: number): void {
    if (!(time > this.begin + restart_s)) return this.#restart(this.yawOfFrame, this.components);
    const { enhanced, binocular, truth, dropped, latency, cpu, memory } = this;
    for (const path of [enhanced, binocular, truth]) path.cut(time);
    for (const series of [...Object.values(this.series), ...dropped.values(), ...latency.values(), ...cpu.values(), ...memory.values()]) series.cut(time);
    for (const { place } of this.corrections.filter((one) => one.time >= time && one.outcome === m.Outcome.applied)) {
      const seen = this.places.all.get(place);
      if (seen) --seen.corrections;
    }
    this.corrections = this.corrections.filter((one) => one.time < time);
    ++this.correctionsTaken; // so that it is noticed
    this.entries = this.entries.filter((one) => one.time < time);
    this.states = this.states.filter((one) => one.time < time);
    this.now = time;
    this.matches = this.recognised = undefined;
    this.#odometer = Odometer.of(binocular);
    this.#pass = [];
    this.#turns.clear();
    this.#rates.clear();
  }

  /** Another drive, of another run of the system. */
  startAnew(): void {
    this.#restart(new Map(), new Map());
  }

  /** Another drive of the same vehicle. */
  #restart(yawOfFrame: Map<string, number>, components: Map<string, Component>): void {
    Object.assign(this, new Drive(), { yawOfFrame, version: this.version + 1, components });
    this.#located_s = -Infinity;
    this.#odometer = new Odometer();
    this.#pass = [];
    this.#passEntry = undefined;
    this.#turns.clear();
    this.#rates.clear();
  }
}
