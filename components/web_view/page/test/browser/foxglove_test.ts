// SPDX-License-Identifier: Apache-2.0
/** Foxglove's own client gets what was published, and reads it with Foxglove's own readers, in both notations of the types. */
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import test, { after, before } from "node:test";
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader as IdlReader } from "@foxglove/omgidl-serialization";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import type { Channel, IWebSocket } from "@foxglove/ws-protocol";
import { WebSocket } from "ws";
import { messages, placeMessages, placeTopics, topics } from "./drive_messages.ts";
import { Publisher } from "./publisher.ts";
import { Server } from "./server.ts";

// node finds no names in an import of this package.
const { FoxgloveClient } = createRequire(import.meta.url)("@foxglove/ws-protocol") as typeof import("@foxglove/ws-protocol");

const server = new Server();
let publisher: Publisher;
const types: Record<string, string> = { ...topics, ...placeTopics };

before(async () => {
  await server.start();
  publisher = new Publisher(server.port);
  await publisher.opened();
  await publisher.advertise(types);
});

after(async () => {
  publisher?.close();
  await server.remove();
});

const plain = (value: unknown): unknown =>
  JSON.parse(JSON.stringify(value, (_, one: unknown) => (ArrayBuffer.isView(one) ? [...(one as Uint8Array)] : typeof one === "bigint" ? Number(one) : one)));

/** Only the members that were published; the others have the defaults of their types. */
function published(read: unknown, message: unknown): unknown {
  if (typeof message !== "object" || message === null || Array.isArray(message)) return read;
  return Object.fromEntries(Object.entries(message).map(([name, value]) => [name, published((read as Record<string, unknown>)[name], value)]));
}

/** The time of a header has other member names in OMG IDL. */
const withRosTime = (text: string) => text.replaceAll('"nsec":', '"nanosec":');

for (const [notation, query] of [["ros2msg", ""], ["omgidl", "?schemas=omgidl"]] as const) {
  test(`every message is read, with types in ${notation}`, { timeout: 60_000 }, async () => {
    const socket = new WebSocket(`ws://127.0.0.1:${server.port}/${query}`, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]);
    const client = new FoxgloveClient({ ws: socket as unknown as IWebSocket });
    const channels = new Map<number, Channel>(); // by subscription
    await new Promise<void>((resolve) =>
      client.on("advertise", (offered) => {
        for (const channel of offered) if (channel.topic in types) channels.set(client.subscribe(channel.id), channel);
        if (channels.size === Object.keys(types).length) resolve();
      }),
    );
    // The answer comes after the subscriptions.
    await new Promise<void>((resolve) => {
      client.on("parameterValues", () => resolve());
      client.getParameters([], "all");
    });
    const expected = new Map<string, unknown>([...messages(), ...placeMessages(new Uint8Array([1, 2, 3]))]); // the last of each topic
    const read = new Map<string, string>();
    const all = new Promise<void>((resolve) =>
      client.on("message", ({ subscriptionId, data }) => {
        const { topic, schema, schemaName } = channels.get(subscriptionId)!;
        const reader = notation === "omgidl" ? new IdlReader(schemaName.replaceAll("/", "::"), parseIDL(schema)) : new MessageReader(parse(schema, { ros2: true }));
        read.set(topic, withRosTime(JSON.stringify(plain(reader.readMessage(data)))));
        if (read.size === expected.size) resolve();
      }),
    );
    for (const [topic, message] of expected) publisher.publish(topic, message);
    await all;
    for (const [topic, message] of expected) {
      const sent = plain(message);
      assert.deepEqual(published(JSON.parse(read.get(topic)!), sent), sent, topic);
    }
    client.close();
  });
}
