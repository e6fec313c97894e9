// SPDX-License-Identifier: Apache-2.0
/** The connection to the server: opens it, opens it again when it is lost, and passes on what comes. */
import { BackOff } from "./back_off.ts";
import { Channels, type Subscription } from "./channels.ts";
import { encoded } from "./codec.ts";
import type { Happening, Order, RoleMessage } from "./events.ts";
import { featuresOf } from "../model/features.ts";
import { matchesOf } from "../model/matches.ts";
import type { PointCloud } from "../model/point_cloud.ts";
import { publishable } from "./initial_pose.ts";
import { Requests } from "./requests.ts";
import { parseBinary, parseText, playedRange, publishFrame, subprotocols, type ServerText } from "./wire.ts";

const batch_ms = 5;

/** What is used of WebSocket. */
export interface Socket {
  binaryType: string;
  onopen: (() => void) | null;
  onclose: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  send(data: string | Uint8Array<ArrayBuffer>): void;
  close(): void;
}

export interface Surroundings {
  connect(url: string, protocols: string[]): Socket;
  after(ms: number, call: () => void): () => void; // returns how to cancel
  emit(happening: Happening): void;
  showImage(subscription: Subscription, message: unknown): void;
}

export class Link {
  #url = "";
  #socket: Socket | undefined;
  #cancelRetry: (() => void) | undefined;
  #attempt = 0;
  #session: string | undefined; // of the server, since it was started
  #backOff = new BackOff();
  #channels = new Channels();
  #requests: Requests;
  #published = new Map<string, number>(); // topic -> channel of this client
  #batch: RoleMessage[] = [];
  #bytes = 0;
  #undecodable = 0;
  #time_s: number | undefined; // of the player

  constructor(readonly surroundings: Surroundings) {
    this.#requests = new Requests((data) => this.#socket?.send(data), surroundings.emit);
  }

  obey(order: Order): void {
    if (order.kind === "open") {
      this.#url = order.url;
      this.#connect();
    } else if (order.kind === "retry") {
      this.#connect();
    } else if (order.kind === "images") {
      this.#channels.wantImages(order.topics);
      this.#settle();
    } else if (order.kind === "publish") {
      this.#publish(order.topic, order.schemaName, order.message);
    } else {
      this.#requests.obey(order);
    }
  }

  /** Passes on what came since the last call. */
  flush(): void {
    if (this.#batch.length === 0) return;
    this.surroundings.emit({ kind: "messages", messages: this.#batch });
    this.#batch = [];
  }

  /** The recording's time, if the server has sent one since the last call. */
  tellTime(): void {
    if (this.#time_s !== undefined) this.surroundings.emit({ kind: "time", time_s: this.#time_s });
    this.#time_s = undefined;
  }

  tellTraffic(): void {
    const traffic = { bytes: this.#bytes, unknown: this.#channels.unknown, undecodable: this.#undecodable };
    this.surroundings.emit({ kind: "traffic", traffic });
  }

  #connect(): void {
    this.#cancelRetry?.();
    this.#leave();
    this.surroundings.emit({ kind: "connecting", attempt: ++this.#attempt });
    let isOpen = false;
    const socket = this.surroundings.connect(this.#url, subprotocols);
    this.#socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => (isOpen = true);
    socket.onmessage = ({ data }) => {
      if (typeof data === "string") this.#onText(data);
      else this.#onBinary(data as ArrayBuffer);
    };
    socket.onclose = () => {
      this.#leave();
      const retry_ms = this.#backOff.next_ms();
      this.surroundings.emit({ kind: "lost", wasOpen: isOpen, retry_ms });
      this.#cancelRetry = this.surroundings.after(retry_ms, () => this.#connect());
    };
  }

  #leave(): void {
    if (this.#socket) {
      this.#socket.onclose = this.#socket.onmessage = this.#socket.onopen = null;
      this.#socket.close();
      this.#socket = undefined;
    }
    this.flush();
    this.#channels.clear();
    this.#published.clear();
    this.#requests.clear();
  }

  #onText(text: string): void {
    const message = parseText(text);
    if (message) this.#handle(message);
  }

  #handle(message: ServerText): void {
    switch (message.op) {
      case "serverInfo":
        this.#backOff.reset();
        this.#attempt = 0;
        this.surroundings.emit({ kind: "open", server: message.name, capabilities: message.capabilities, isAnotherRun: this.#isAnotherRun(message.sessionId), ...playedRange(message) });
        break;
      case "advertise":
        this.#channels.offer(message.channels);
        this.#changedTopics();
        break;
      case "unadvertise":
        this.#channels.withdraw(message.channelIds);
        this.#changedTopics();
        break;
      case "status":
        this.surroundings.emit({ kind: "status", level: message.level, message: message.message });
        break;
      default:
        this.#requests.handle(message);
    }
  }

  /** Whether the server was started since the last session: what came before is of another drive. */
  #isAnotherRun(sessionId = ""): boolean {
    const before = this.#session;
    this.#session = sessionId.replace(/-timed$/, ""); // panvo's server tells so that it goes on with the time of a simulation
    return before !== undefined && before !== this.#session;
  }

  #changedTopics(): void {
    this.#settle();
    this.surroundings.emit({ kind: "topics", topics: this.#channels.topics });
  }

  #settle(): void {
    const { subscribe, unsubscribe } = this.#channels.settle();
    if (unsubscribe.length > 0) this.#send({ op: "unsubscribe", subscriptionIds: unsubscribe });
    if (subscribe.length > 0) this.#send({ op: "subscribe", subscriptions: subscribe });
  }

  #onBinary(frame: ArrayBuffer): void {
    this.#bytes += frame.byteLength;
    const message = parseBinary(frame);
    if (message?.op === "reply") this.#requests.reply(message);
    if (message?.op === "time") this.#time_s = Number(message.timeNs) * 1e-9;
    if (message?.op !== "message") return;
    const subscription = this.#channels.find(message.subscription);
    if (!subscription) return;
    try {
      const content = subscription.read(message.payload);
      if (!subscription.role) this.surroundings.showImage(subscription, content);
      else this.#collect({ role: subscription.role, topic: subscription.channel.topic, message: shortened(subscription.role, content) });
    } catch {
      ++this.#undecodable;
    }
    if (!this.#channels.keepsWanting(subscription)) this.#settle();
  }

  /** Messages of the same few milliseconds wake the page once. */
  #collect(message: RoleMessage): void {
    if (this.#batch.push(message) === 1) this.surroundings.after(batch_ms, () => this.flush());
  }

  #publish(topic: string, schemaName: string, message: unknown): void {
    const schema = publishable[schemaName];
    if (!this.#socket || schema === undefined) return;
    let channel = this.#published.get(topic);
    if (channel === undefined) {
      channel = this.#published.size + 1;
      this.#published.set(topic, channel);
      this.#send({ op: "advertise", channels: [{ id: channel, topic, encoding: "cdr", schemaName, schema, schemaEncoding: "ros2msg" }] });
    }
    this.#socket.send(publishFrame(channel, encoded(schema, message)));
  }

  #send(object: unknown): void {
    this.#socket?.send(JSON.stringify(object));
  }
}

/** Without the features of a landmark, which nobody looks at and which are most of its bytes; of a point cloud what is drawn. */
function shortened(role: string, message: unknown): unknown {
  if (role === "points") return featuresOf(message as PointCloud);
  if (role === "matchPoints") return matchesOf(message as PointCloud);
  if (role !== "landmark") return message;
  const { header, id, pose, is_junction, thumbnail } = message as Record<string, unknown>;
  return { header, id, pose, is_junction, thumbnail: (thumbnail as Uint8Array).slice() };
}
