// SPDX-License-Identifier: Apache-2.0
/** Which channels the server offers, which of them the page wants, and what it has subscribed to. */
import { readerOf } from "./codec.ts";
import type { Traffic } from "./events.ts";
import { imageTypes, roleOf, type Role } from "./roles.ts";
import type { Channel } from "./wire.ts";

/** Message of a path topic: the past before the page was opened. One is enough. */
const onceOnly: readonly Role[] = ["pathEnhanced", "pathBinocular"];

export interface Subscription {
  id: number;
  channel: Channel;
  role: Role | undefined; // undefined: an image
  read: (payload: Uint8Array) => unknown;
}

export interface Change {
  subscribe: { id: number; channelId: number }[];
  unsubscribe: number[];
}

export class Channels {
  #offered = new Map<number, Channel>();
  #subscriptions = new Map<number, Subscription>(); // by their ids
  #images = new Set<string>();
  #done = new Set<number>(); // channels of which no more is wanted
  #unknown = new Map<number, Traffic["unknown"][number]>();
  #nextId = 1;

  /** After a connection ended. */
  clear(): void {
    this.#offered.clear();
    this.#subscriptions.clear();
    this.#done.clear();
    this.#unknown.clear();
  }

  offer(channels: Channel[]): void {
    for (const channel of channels) this.#offered.set(channel.id, channel);
  }

  /** The server ends the subscriptions by itself. */
  withdraw(ids: number[]): void {
    for (const id of ids) {
      this.#offered.delete(id);
      this.#done.delete(id);
      this.#unknown.delete(id);
      for (const subscription of this.#subscriptions.values()) {
        if (subscription.channel.id === id) this.#subscriptions.delete(subscription.id);
      }
    }
  }

  wantImages(topics: string[]): void {
    this.#images = new Set(topics);
  }

  /** A message of a subscription; returns false if it was the last that is wanted. */
  keepsWanting(subscription: Subscription): boolean {
    if (!subscription.role || !onceOnly.includes(subscription.role)) return true;
    this.#done.add(subscription.channel.id);
    return false;
  }

  /** What to tell the server so that it sends just what is wanted. */
  settle(): Change {
    const change: Change = { subscribe: [], unsubscribe: [] };
    const has = new Set<number>();
    for (const { id, channel } of [...this.#subscriptions.values()]) {
      if (this.#isWanted(channel)) {
        has.add(channel.id);
      } else {
        change.unsubscribe.push(id);
        this.#subscriptions.delete(id);
      }
    }
    for (const channel of this.#offered.values()) {
      if (has.has(channel.id) || !this.#isWanted(channel)) continue;
      const subscription = this.#subscriptionOf(channel);
      if (!subscription) continue;
      this.#subscriptions.set(subscription.id, subscription);
      change.subscribe.push({ id: subscription.id, channelId: channel.id });
    }
    return change;
  }

  find(subscription: number): Subscription | undefined {
    return this.#subscriptions.get(subscription);
  }

  get topics(): { topic: string; type: string }[] {
    return [...this.#offered.values()].map(({ topic, schemaName }) => ({ topic, type: schemaName }));
  }

  get unknown(): Traffic["unknown"] {
    return [...this.#unknown.values()];
  }

  #isWanted(channel: Channel): boolean {
    if (this.#done.has(channel.id) || this.#unknown.has(channel.id)) return false;
    if (imageTypes.includes(channel.schemaName)) return this.#images.has(channel.topic);
    const role = roleOf(channel);
    return role === "points" ? this.#images.size > 0 : role !== undefined; // points are drawn into an image
  }

  #subscriptionOf(channel: Channel): Subscription | undefined {
    try {
      if (channel.encoding !== "cdr") throw new Error(`its encoding is ${channel.encoding}`);
      const reader = readerOf(channel.schema);
      return { id: this.#nextId++, channel, role: roleOf(channel), read: (payload) => reader.readMessage(payload) };
    } catch (error) {
      this.#unknown.set(channel.id, { topic: channel.topic, type: channel.schemaName, why: String((error as Error).message) });
      return undefined;
    }
  }
}
