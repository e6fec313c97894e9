// SPDX-License-Identifier: Apache-2.0
// read_bags.mjs BAGS: reads the bags written by witness_bags with third-party readers and compares topics, times and
// messages with expected.json. For MCAP, the type definitions come from the bags.
import fs from "fs";
import path from "path";
import { createRequire } from "module";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { loadDecompressHandlers } from "@mcap/support";
import rosmsg from "@foxglove/rosmsg";
import serialization from "@foxglove/rosmsg2-serialization";

globalThis.File ??= class {}; // browser API that rosbag2-web needs
const require = createRequire(import.meta.url);
const { SqliteSqljs } = require("@foxglove/rosbag2-web/dist/SqliteSqljs.js");
const { Rosbag2 } = require("@foxglove/rosbag2");

const folder = process.argv[2];
const expected = JSON.parse(fs.readFileSync(path.join(folder, "expected.json"), "utf8"));

let failures = 0;
function check(what, got, wanted) {
  if (String(got) !== String(wanted)) {
    console.log(`${what}: ${got}, expected ${wanted}`);
    ++failures;
  }
}

function fileOf(bag) {
  const directory = path.join(folder, bag);
  return path.join(directory, fs.readdirSync(directory).find((name) => /\.(db3|mcap)$/.test(name)));
}

// Compares the decoded fields with the expected ones, and the bytes, read and serialized again, with those written.
function compareMessage(where, message, wanted, data, definitions) {
  if (wanted.x !== undefined) {
    check(`${where} position`, message.pose.pose.position.x, wanted.x);
    check(`${where} frame`, message.header.frame_id, wanted.frame);
    check(`${where} covariance`, message.pose.covariance[35], wanted.covariance);
  }
  if (data) {
    check(`${where} bytes`, Buffer.from(data).toString("hex"), wanted.bytes);
    const again = new serialization.MessageWriter(definitions).writeMessage(message);
    check(`${where} bytes serialized again`, Buffer.from(again).toString("hex"), wanted.bytes);
  }
}

async function readSqlite(bag) {
  const database = new SqliteSqljs(new Uint8Array(fs.readFileSync(fileOf(bag))));
  const reader = new Rosbag2([database]);
  await reader.open();
  const topics = new Map((await reader.readTopics()).map((topic) => [topic.name, topic]));
  for (const topic of expected.topics) {
    check(`${bag} type of ${topic.name}`, topics.get(topic.name)?.type, topic.type);
  }
  let count = 0;
  for await (const message of reader.readMessages()) {
    const wanted = expected.messages[count++];
    check(`${bag} topic ${count}`, message.topic.name, wanted.topic);
    check(`${bag} time ${count}`, BigInt(message.timestamp.sec) * 1_000_000_000n + BigInt(message.timestamp.nsec), wanted.time);
    compareMessage(`${bag} message ${count}`, message.value, wanted);
  }
  check(`${bag} messages`, count, expected.messages.length);
}

async function readMcap(bag, decompressHandlers) {
  const bytes = fs.readFileSync(fileOf(bag));
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  check(`${bag} profile`, reader.header.profile, "ros2");
  check(`${bag} statistics`, reader.statistics?.messageCount, expected.messages.length);
  const definitions = new Map();
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    const topic = expected.topics.find(({ name }) => name === channel.topic);
    check(`${bag} type of ${channel.topic}`, schema.name, topic?.type);
    check(`${bag} hash of ${channel.topic}`, channel.metadata.get("topic_type_hash"), topic?.hash);
    check(`${bag} schema of ${channel.topic}`, schema.encoding, "ros2msg");
    definitions.set(channel.id, rosmsg.parse(new TextDecoder().decode(schema.data), { ros2: true }));
  }
  let count = 0;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const wanted = expected.messages[count++];
    check(`${bag} topic ${count}`, reader.channelsById.get(message.channelId).topic, wanted.topic);
    check(`${bag} time ${count}`, message.logTime, wanted.time);
    const types = definitions.get(message.channelId);
    const decoded = new serialization.MessageReader(types).readMessage(message.data);
    compareMessage(`${bag} message ${count}`, decoded, wanted, message.data, types);
  }
  check(`${bag} messages`, count, expected.messages.length);

  // Read as a stream: checks every record and checksum.
  const stream = new McapStreamReader({ validateCrcs: true, decompressHandlers });
  stream.append(bytes);
  let streamed = 0;
  for (let record; (record = stream.nextRecord()); ) {
    streamed += record.type === "Message" ? 1 : 0;
  }
  check(`${bag} end`, stream.done(), true);
  check(`${bag} messages in a stream`, streamed, expected.messages.length);
}

await SqliteSqljs.Initialize({
  wasmBinary: fs.readFileSync(require.resolve("@foxglove/sql.js/dist/sql-wasm.wasm")),
});
const decompressHandlers = await loadDecompressHandlers();
for (const bag of expected.bags) {
  if (fileOf(bag).endsWith(".db3")) {
    await readSqlite(bag);
  } else {
    await readMcap(bag, decompressHandlers);
  }
  console.log(`${bag}: ${expected.messages.length} messages compared`);
}
process.exit(failures === 0 ? 0 : 1);
