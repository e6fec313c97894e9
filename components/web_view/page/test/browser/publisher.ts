// SPDX-License-Identifier: Apache-2.0
/** Publishes messages through the web view, as a Foxglove client, by the definitions that the web view itself sends. */
import { WebSocket } from "ws";
import { encoded, readerOf } from "../../src/link/codec.ts";
import { parseBinary, publishFrame, subprotocols, type Channel } from "../../src/link/wire.ts";

export class Publisher {
  #socket: WebSocket;
  #offered = new Map<string, Channel>();
  #published = new Map<string, number>();
  #waiting: (() => void)[] = [];
  #subscribed = new Set<string>(); // ids of requests that were answered
  received: { topic: string; message: unknown }[] = [];
  #topics = new Map<number, Channel>(); // by subscription

  constructor(port: number) {
    this.#socket = new WebSocket(`ws://127.0.0.1:${port}/`, subprotocols);
    this.#socket.binaryType = "arraybuffer";
    this.#socket.on("message", (data: ArrayBuffer | Buffer, isBinary: boolean) => {
      if (isBinary) this.#onMessage(data as ArrayBuffer);
      else this.#onText(JSON.parse(data.toString()));
      for (const wake of this.#waiting.splice(0)) wake();
    });
  }

  opened(): Promise<void> {
    return new Promise((resolve, reject) => this.#socket.once("open", resolve).once("error", reject));
  }

  close(): void {
    this.#socket.close();
  }

  /** Makes the topics known, so that they can be published and the page subscribes to them. */
  async advertise(types: Record<string, string>): Promise<void> {
    const channels = Object.entries(types).map(([topic, schemaName]) => {
      const id = this.#published.size + 1;
      this.#published.set(topic, id);
      return { id, topic, encoding: "cdr", schemaName };
    });
    this.#send({ op: "advertise", channels });
    await this.until(() => Object.keys(types).every((topic) => this.#offered.has(topic)));
  }

  publish(topic: string, message: unknown): void {
    this.#socket.send(publishFrame(this.#published.get(topic)!, encoded(this.#offered.get(topic)!.schema, message)));
  }

  /** Resolves when the web view has subscribed. */
  async subscribe(topic: string): Promise<void> {
    await this.until(() => this.#offered.has(topic));
    const channel = this.#offered.get(topic)!;
    this.#topics.set(channel.id, channel);
    this.#send({ op: "subscribe", subscriptions: [{ id: channel.id, channelId: channel.id }] });
    this.#send({ op: "getParameters", parameterNames: [], id: topic }); // answered after what was asked before
    await this.until(() => this.#subscribed.has(topic));
  }

  async until(isTrue: () => boolean): Promise<void> {
    while (!isTrue()) await new Promise<void>((resolve) => this.#waiting.push(resolve));
  }

  #send(object: unknown): void {
    this.#socket.send(JSON.stringify(object));
  }

  #onText(message: { op: string; channels?: Channel[]; level?: number; message?: string; id?: string }): void {
    if (message.op === "advertise") for (const channel of message.channels!) this.#offered.set(channel.topic, channel);
    if (message.op === "parameterValues" && message.id) this.#subscribed.add(message.id);
    if (message.op === "status" && message.level === 2) throw new Error(`the web view says: ${message.message}`);
  }

  #onMessage(frame: ArrayBuffer): void {
    const message = parseBinary(frame);
    const channel = message?.op === "message" ? this.#topics.get(message.subscription) : undefined;
    if (message?.op === "message" && channel) this.received.push({ topic: channel.topic, message: readerOf(channel.schema).readMessage(message.payload) });
  }
}
