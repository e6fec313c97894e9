// SPDX-License-Identifier: Apache-2.0
/** The page: puts the panels together and gives each what comes over the connection. */
import { Cameras } from "./cameras/cameras.ts";
import { isOfThisMachine, shownAddress } from "./link/address.ts";
import type { Happening, Order } from "./link/events.ts";
import { initialPose } from "./link/initial_pose.ts";
import { MapView } from "./map/map.ts";
import { Drive } from "./model/drive.ts";
import type { Entry } from "./model/happenings.ts";
import type { Heads } from "./model/head.ts";
import { panoramaFrame, playInto, type RecordedDrive } from "./model/recorded_drive.ts";
import { restoreSnapshot, takeSnapshot, type Snapshot } from "./model/snapshot.ts";
import { ActionsPanel } from "./panels/actions_panel.ts";
import { ConnectionPanel } from "./panels/connection_panel.ts";
import { EventsPanel } from "./panels/events_panel.ts";
import { MapPanel } from "./panels/map_panel.ts";
import { ParametersPanel } from "./panels/parameters_panel.ts";
import { PlayerPanel } from "./panels/player_panel.ts";
import { RecorderPanel } from "./panels/recorder_panel.ts";
import { ReportPanel } from "./panels/report_panel.ts";
import { StatePanel } from "./panels/state_panel.ts";
import { SystemPanel } from "./panels/system_panel.ts";
import { Timeline } from "./timeline/timeline.ts";
import { byId, setText } from "./ui/dom.ts";
import { download, snapshotPage } from "./ui/snapshot_file.ts";
import { Tabs } from "./ui/tabs.ts";

const images_ms = 1500; // longest time that a snapshot waits for images
const poseRoles = ["enhanced", "binocular", "state"];

export class App {
  drive = new Drive();
  topics: { topic: string; type: string }[] = [];
  map = new MapView(byId("map-canvas"), this.drive);
  send: (order: Order) => void = () => {}; // to the connection
  #poseCame_ms = performance.now();
  #isLive = false;
  #heads: Heads | undefined; // of a recorded drive
  #server = "";
  #calls = new Map<number, { resolve: (response: unknown) => void; reject: (error: Error) => void }>();
  #call = (service: string, request: unknown): Promise<unknown> =>
    new Promise((resolve, reject) => {
      const call = ++this.#lastCall;
      this.#calls.set(call, { resolve, reject });
      this.send({ kind: "call", call, service, request });
    });
  #lastCall = 0;
  connection = new ConnectionPanel((url) => this.send({ kind: "open", url }));
  mapPanel = new MapPanel(this.map, this.drive, (pose) => {
    this.send({ kind: "publish", topic: "/initialpose", schemaName: "geometry_msgs/msg/PoseWithCovarianceStamped", message: initialPose(pose) });
    this.notify("Pose sent to /initialpose");
  });
  cameras = new Cameras(byId("cameras"), this.drive, (topics) => this.send({ kind: "images", topics }));
  report = new ReportPanel();
  #state = new StatePanel();
  #timeline = new Timeline(byId("time"), this.drive, (time) => {
    this.map.cursor_s = time;
    this.map.draw();
    if (!this.#heads) return;
    this.cameras.showAt(time);
    this.#updateState();
  });
  #events = new EventsPanel(byId("events"), this.drive, (entry) => this.#showEvent(entry));
  #system = new SystemPanel(byId("components"), this.drive);
  #player = new PlayerPanel(byId("player"), this.#call);
  #recorders = new RecorderPanel(byId("recorders"), this.#call);
  #actions = new ActionsPanel(byId("actions"), this.#call);
  #parameters = new ParametersPanel(byId("parameters"), (order) => this.send(order), this.#call);
  #tabs = new Tabs(() => this.#onTab());

  /** Called with each frame. */
  frame(): void {
    this.map.update();
  }

  /** What is read rather than watched: a few times a second. */
  update(): void {
    this.#updateState();
    this.connection.update();
    this.mapPanel.update();
    if (this.#tabs.isSeen("cameras")) this.cameras.update();
    if (this.#tabs.isSeen("events")) this.#events.update();
    if (this.#tabs.isSeen("system")) {
      this.#system.update();
      this.#recorders.update();
    }
    if (this.#tabs.isSeen("time")) this.#timeline.update();
  }

  #updateState(): void {
    const silent_s = this.#isLive ? (performance.now() - this.#poseCame_ms) / 1000 : 0;
    const head = this.#heads?.at(this.map.cursor_s) ?? this.drive;
    this.#state.update(head, { silent_s, link: this.connection.state, isPaused: this.#player.isPaused });
  }

  on(happening: Happening): void {
    switch (happening.kind) {
      case "messages":
        for (const message of happening.messages) this.drive.take(message);
        if (happening.messages.some(({ role }) => poseRoles.includes(role))) this.#poseCame_ms = performance.now();
        if (happening.messages.some(({ role }) => role === "points")) this.cameras.onFeatures();
        break;
      case "image":
        this.cameras.show(happening);
        break;
      case "imageFault":
        this.cameras.fault(happening.topic, happening.why);
        break;
      case "connecting":
        this.connection.connecting();
        break;
      case "open":
        if (happening.isAnotherRun) this.drive.startAnew();
        this.#player.range_s = happening.range_s;
        this.#onOpen(happening.server, happening.capabilities);
        break;
      case "lost":
        this.#onLost(happening.wasOpen, happening.retry_ms);
        break;
      case "topics":
        this.topics = happening.topics;
        this.cameras.offer(happening.topics, isOfThisMachine(this.connection.address));
        break;
      case "services":
        this.#actions.offer(happening.services);
        this.#recorders.offer(happening.services);
        this.#player.offer(happening.services);
        break;
      case "parameters":
        this.#parameters.show(happening.parameters);
        break;
      case "reply":
        this.#onReply(happening);
        break;
      case "status":
        if (happening.level > 1) this.notify(happening.message);
        else this.#system.setNotice(happening.message);
        break;
      case "time":
        this.#player.time_s = happening.time_s;
        break;
      case "traffic":
        this.#system.setTraffic(happening.traffic, this.#server, shownAddress(this.connection.address));
    }
  }

  show(snapshot: Snapshot): void {
    restoreSnapshot(this.drive, snapshot);
    this.#timeline.choose(Infinity);
    for (const [kind, url] of Object.entries(snapshot.pictures)) {
      const image = new Image();
      image.onload = () => this.cameras.restore(kind as "left" | "panorama", image, snapshot.panoramaFrame);
      image.src = url;
    }
    this.connection.snapshot(snapshot.taken);
    setText(this.cameras.empty, "No image was received before the snapshot.");
    this.#showWhole();
  }

  /** A drive that has ended: the cursor of the time line moves along it. */
  showRecorded(recorded: RecordedDrive): void {
    this.#timeline.staysAt = true;
    this.#heads = playInto(this.drive, recorded);
    this.cameras.keep(recorded.pictures, panoramaFrame);
    this.cameras.showAt(undefined);
    this.connection.recorded(recorded.title);
    this.report.show(recorded.report);
    this.#timeline.choose(Infinity);
    this.#showWhole();
  }

  #showWhole(): void {
    byId("snapshot-button").hidden = true;
    this.update();
    this.map.fit();
  }

  /** Back or on by tens of seconds in a bag, by seconds in a recorded drive. */
  jump(steps: number): void {
    if (this.#heads) this.#timeline.step(steps);
    else this.player.jump(10 * steps);
  }

  async takeSnapshot(): Promise<void> {
    try {
      await this.#fetchImages();
      const taken = new Date();
      const snapshot = takeSnapshot(this.drive, this.cameras.pictures(), this.cameras.panoramaFrame, taken);
      download(await snapshotPage(snapshot), `panvo_${taken.toISOString().slice(0, 19).replace(/[:T]/g, "-")}.html`);
    } catch (error) {
      this.notify(`No snapshot: ${(error as Error).message}`);
    }
  }

  /** On a phone, images are not received while the map is seen. */
  async #fetchImages(): Promise<void> {
    this.cameras.setVisible(true);
    const end = performance.now() + images_ms;
    while (this.cameras.isWaiting && performance.now() < end) await new Promise((resolve) => setTimeout(resolve, 50));
    this.#onTab();
  }

  get player(): PlayerPanel {
    return this.#player;
  }

  notify(text: string): void {
    const note = byId("note");
    setText(note, text);
    note.classList.add("shown");
    clearTimeout(this.#noteTimer);
    this.#noteTimer = setTimeout(() => note.classList.remove("shown"), 5000);
  }
  #noteTimer: ReturnType<typeof setTimeout> | undefined;

  #onOpen(server: string, capabilities: string[]): void {
    this.#isLive = true;
    this.#server = server;
    this.#poseCame_ms = performance.now();
    this.connection.opened();
    this.mapPanel.setControl(capabilities.includes("clientPublish"));
    this.#parameters.setAllowed(capabilities.includes("parameters"), capabilities.includes("clientPublish"));
    if (capabilities.includes("services")) return;
    this.#actions.offer([]);
    this.#recorders.offer([]);
  }

  #onLost(wasOpen: boolean, retry_ms: number): void {
    this.mapPanel.setControl(false);
    this.#parameters.setAllowed(false, false);
    this.#actions.offer([]);
    this.#recorders.offer([]);
    this.#player.offer([]);
    void this.connection.lost(wasOpen, retry_ms);
  }

  #onReply({ call, response, fault }: Extract<Happening, { kind: "reply" }>): void {
    const waiting = this.#calls.get(call);
    this.#calls.delete(call);
    if (fault === undefined) waiting?.resolve(response);
    else waiting?.reject(new Error(fault));
  }

  /** Where it happened; in a recorded drive, the cursor goes to its time. */
  #showEvent({ at, time }: Entry): void {
    if (this.#heads) this.#timeline.moveTo(time);
    if (!at) return;
    this.map.centre(at);
    if (!this.#tabs.isSeen("map")) this.#tabs.choose("map");
  }

  #onTab(): void {
    this.cameras.setVisible(document.body.dataset.tab === "cameras");
    requestAnimationFrame(() => this.update());
  }
}
