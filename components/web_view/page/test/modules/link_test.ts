// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import test from "node:test";
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
import { serverAddress, shownAddress } from "../../src/link/address.ts";
import { BackOff } from "../../src/link/back_off.ts";
import type { Happening } from "../../src/link/events.ts";
import { initialPose, publishable } from "../../src/link/initial_pose.ts";
import { Link, type Socket } from "../../src/link/link.ts";
import { callFrame, parseBinary, parseText } from "../../src/link/wire.ts";
import { near } from "./make.ts";

class FakeSocket implements Socket {
  binaryType = "";
  onopen: (() => void) | null = null;
  onclose: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  sent: (string | Uint8Array)[] = [];
  isClosed = false;
  send(data: string | Uint8Array): void {
    this.sent.push(data);
  }
  close(): void {
    this.isClosed = true;
  }
  say(object: unknown): void {
    this.onmessage?.({ data: JSON.stringify(object) });
  }
  asked(): { op: string; [key: string]: unknown }[] {
    return this.sent.filter((data) => typeof data === "string").map((data) => JSON.parse(data as string));
  }
}

const state = "std_msgs/Header header\nuint8 state\n===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n===\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
const channel = (id: number, topic: string, schemaName: string, schema = state) => ({ id, topic, schemaName, schema, encoding: "cdr" });

function started() {
  const sockets: FakeSocket[] = [];
  const happenings: Happening[] = [];
  const timers: { ms: number; call: () => void }[] = [];
  const link = new Link({
    connect: () => {
      sockets.push(new FakeSocket());
      return sockets[sockets.length - 1]!;
    },
    after: (ms, call) => {
      timers.push({ ms, call });
      return () => {};
    },
    emit: (happening) => void happenings.push(happening),
    showImage: () => {},
  });
  link.obey({ kind: "open", url: "ws://here/" });
  const socket = sockets[0]!;
  socket.onopen?.();
  socket.say({ op: "serverInfo", name: "panvo", capabilities: ["clientPublish"] });
  return { link, sockets, happenings, timers, socket };
}

function frame(subscription: number, payload: Uint8Array): ArrayBuffer {
  const bytes = new Uint8Array(13 + payload.length);
  bytes[0] = 1;
  new DataView(bytes.buffer).setUint32(1, subscription, true);
  bytes.set(payload, 13);
  return bytes.buffer;
}

test("topics with a role are subscribed to, and images only while they are wanted", () => {
  const { link, socket } = started();
  socket.say({ op: "advertise", channels: [channel(7, "/localization/state", "panvo_msgs/msg/LocalizationState"), channel(8, "/other", "std_msgs/msg/String"), channel(9, "/panorama/image", "sensor_msgs/msg/Image")] });
  assert.deepEqual(socket.asked(), [{ op: "subscribe", subscriptions: [{ id: 1, channelId: 7 }] }]);
  link.obey({ kind: "images", topics: ["/panorama/image"] });
  link.obey({ kind: "images", topics: [] });
  assert.deepEqual(socket.asked().slice(1), [
    { op: "subscribe", subscriptions: [{ id: 2, channelId: 9 }] },
    { op: "unsubscribe", subscriptionIds: [2] },
  ]);
});

test("messages are decoded and passed on with their role", () => {
  const { link, socket, happenings } = started();
  socket.say({ op: "advertise", channels: [channel(7, "/localization/state", "panvo_msgs/msg/LocalizationState")] });
  const bytes = new MessageWriter(parse(state, { ros2: true })).writeMessage({ header: { stamp: { sec: 3, nanosec: 4 }, frame_id: "map" }, state: 3 });
  socket.onmessage?.({ data: frame(1, bytes) });
  socket.onmessage?.({ data: frame(1, bytes.subarray(0, 9)) }); // cut off
  socket.onmessage?.({ data: frame(55, bytes) }); // nobody asked for it
  link.flush();
  link.tellTraffic();
  const { messages } = happenings.find(({ kind }) => kind === "messages") as Extract<Happening, { kind: "messages" }>;
  assert.deepEqual(messages, [{ role: "state", topic: "/localization/state", message: { header: { stamp: { sec: 3, nanosec: 4 }, frame_id: "map" }, state: 3 } }]);
  const { traffic } = happenings[happenings.length - 1] as Extract<Happening, { kind: "traffic" }>;
  assert.equal(traffic.undecodable, 1);
});

test("topics without a usable definition are counted, not subscribed to", () => {
  const { link, socket, happenings } = started();
  socket.say({ op: "advertise", channels: [channel(1, "/landmarks", "panvo_msgs/msg/PanoramicLandmark", ""), { ...channel(2, "/correction/outcome", "panvo_msgs/msg/CorrectionOutcome"), encoding: "json" }] });
  assert.deepEqual(socket.asked(), []);
  link.tellTraffic();
  const { traffic } = happenings[happenings.length - 1] as Extract<Happening, { kind: "traffic" }>;
  assert.deepEqual(traffic.unknown.map(({ topic }) => topic), ["/landmarks", "/correction/outcome"]);
});

test("the time range of the recording comes from serverInfo", () => {
  const { socket, happenings } = started();
  socket.say({ op: "serverInfo", name: "panvo", capabilities: [], dataStartTime: { sec: 10, nsec: 500_000_000 }, dataEndTime: { sec: 90, nsec: 0 } });
  const ranges = happenings.filter(({ kind }) => kind === "open").map((one) => (one as { range_s?: [number, number] }).range_s);
  assert.deepEqual(ranges, [undefined, [10.5, 90]]);
});

test("a lost server is retried with growing delays until it answers", () => {
  const { sockets, timers, happenings } = started();
  for (let i = 0; i < 3; ++i) {
    sockets[i]!.onclose?.();
    timers[i]!.call();
  }
  assert.deepEqual(timers.map(({ ms }) => ms), [500, 1000, 2000]);
  assert.deepEqual(happenings.filter(({ kind }) => kind === "lost").map((one) => (one as { wasOpen: boolean }).wasOpen), [true, false, false]);
  sockets[3]!.say({ op: "serverInfo", name: "panvo", capabilities: [] });
  sockets[3]!.onclose?.();
  assert.equal(timers[3]!.ms, 500);
});

test("a server that was started anew begins another run, and one with a time of its own does not", () => {
  const { sockets, timers, happenings } = started();
  const greet = (socket: FakeSocket, sessionId: string) => socket.say({ op: "serverInfo", name: "panvo", capabilities: [], sessionId });
  const reconnect = () => {
    sockets[sockets.length - 1]!.onclose?.();
    timers[timers.length - 1]!.call();
    return sockets[sockets.length - 1]!;
  };
  let socket = reconnect();
  greet(socket, "12");
  greet(socket, "12-timed");
  socket = reconnect();
  greet(socket, "12-timed");
  socket = reconnect();
  greet(socket, "13");
  const isAnother = happenings.filter(({ kind }) => kind === "open").slice(1).map((one) => (one as { isAnotherRun: boolean }).isAnotherRun);
  assert.deepEqual(isAnother, [true, false, false, true]);
});

test("waiting times have a limit", () => {
  const backOff = new BackOff(500, 10_000);
  const times = Array.from({ length: 8 }, () => backOff.next_ms());
  assert.deepEqual(times, [500, 1000, 2000, 4000, 8000, 10_000, 10_000, 10_000]);
});

test("a pose is advertised once and published as CDR", () => {
  const { link, socket } = started();
  const type = "geometry_msgs/msg/PoseWithCovarianceStamped";
  for (let i = 0; i < 2; ++i) link.obey({ kind: "publish", topic: "/initialpose", schemaName: type, message: initialPose({ x: 1, y: 2, yaw: Math.PI / 2 }) });
  assert.deepEqual(socket.asked().map(({ op }) => op), ["advertise"]);
  const bytes = socket.sent.filter((data) => typeof data !== "string");
  assert.equal(bytes.length, 2);
  const payload = (bytes[0] as Uint8Array).subarray(5);
  const { header, pose } = new MessageReader(parse(publishable[type]!, { ros2: true })).readMessage<ReturnType<typeof initialPose>>(payload);
  assert.equal(header.frame_id, "map");
  assert.deepEqual(pose.pose.position, { x: 1, y: 2, z: 0 });
  near(pose.pose.orientation.w, Math.SQRT1_2);
  assert.equal(pose.covariance[0], 0.25);
});

test("a service call gets its response or the reason of the failure", () => {
  const { link, socket, happenings } = started();
  socket.say({ op: "advertiseServices", services: [{ id: 5, name: "/save", type: "std_srvs/srv/Trigger", request: { schemaName: "", schema: "" }, response: { schemaName: "", schema: "bool success\nstring message\n" } }] });
  link.obey({ kind: "call", call: 1, service: "/save", request: {} });
  link.obey({ kind: "call", call: 2, service: "/other", request: {} });
  const response = new MessageWriter(parse("bool success\nstring message\n", { ros2: true })).writeMessage({ success: true, message: "ok" });
  const reply = callFrame(5, 1, response);
  reply[0] = 3;
  socket.onmessage?.({ data: reply.buffer });
  const replies = happenings.filter(({ kind }) => kind === "reply");
  assert.deepEqual(replies, [
    { kind: "reply", call: 2, fault: "unknown service /other" },
    { kind: "reply", call: 1, response: { success: true, message: "ok" } },
  ]);
});

test("messages outside the protocol are ignored", () => {
  for (const text of ["", "{", "null", "[]", '{"op":3}']) assert.equal(parseText(text), undefined);
  assert.equal(parseBinary(new ArrayBuffer(0)), undefined);
  assert.equal(parseBinary(new Uint8Array([1, 2, 3]).buffer), undefined);
  assert.equal(parseBinary(new Uint8Array([3, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255]).buffer), undefined);
});

test("the server is where the page came from, unless another is named", () => {
  assert.equal(serverAddress("http://robot:8765/?token=a%26b", "a&b"), "ws://robot:8765/?token=a%26b");
  assert.equal(serverAddress("https://robot/", ""), "wss://robot/");
  assert.equal(serverAddress("http://here:1/?server=ws://there:2/", ""), "ws://there:2/");
  assert.equal(shownAddress("ws://robot:8765/?token=secret"), "ws://robot:8765");
});
