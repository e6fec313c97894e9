// SPDX-License-Identifier: Apache-2.0
/** Foxglove's WebSocket protocol: what goes over the connection, without the connection. */

export const subprotocols = ["foxglove.sdk.v1", "foxglove.websocket.v1"];

export interface Channel {
  id: number;
  topic: string;
  encoding: string;
  schemaName: string;
  schema: string;
}

interface ServiceSide {
  schemaName: string;
  schema: string;
}

export interface Service {
  id: number;
  name: string;
  type: string;
  request?: ServiceSide;
  response?: ServiceSide;
  requestSchema?: string;
  responseSchema?: string;
}

export type ParameterValue = boolean | number | string | ParameterValue[] | { [key: string]: ParameterValue };

export interface Parameter {
  name: string;
  value?: ParameterValue;
  type?: string;
}

export interface Time {
  sec: number;
  nsec: number;
}

export type ServerText =
  | { op: "serverInfo"; name: string; capabilities: string[]; sessionId?: string; dataStartTime?: Time; dataEndTime?: Time }
  | { op: "status"; level: number; message: string }
  | { op: "advertise"; channels: Channel[] }
  | { op: "unadvertise"; channelIds: number[] }
  | { op: "advertiseServices"; services: Service[] }
  | { op: "unadvertiseServices"; serviceIds: number[] }
  | { op: "parameterValues"; parameters: Parameter[]; id?: string }
  | { op: "serviceCallFailure"; serviceId: number; callId: number; message: string };

const seconds = ({ sec, nsec }: Time): number => sec + nsec * 1e-9;

/** First and last time of what the server plays, if it tells. */
export function playedRange({ dataStartTime: first, dataEndTime: last }: { dataStartTime?: Time; dataEndTime?: Time }): { range_s?: [number, number] } {
  return first && last ? { range_s: [seconds(first), seconds(last)] } : {};
}

/** Undefined: not a message of the protocol. Operations that are not in ServerText are returned too, and ignored by users. */
export function parseText(text: string): ServerText | undefined {
  try {
    const object = JSON.parse(text) as { op?: unknown } | null;
    return object && typeof object.op === "string" ? (object as ServerText) : undefined;
  } catch {
    return undefined;
  }
}

export type ServerBinary =
  | { op: "message"; subscription: number; timeNs: bigint; payload: Uint8Array }
  | { op: "time"; timeNs: bigint }
  | { op: "reply"; service: number; call: number; payload: Uint8Array };

const messageHead = 13;
const replyHead = 13;

/** Undefined: too short, or of another kind. The payload is a view of the frame. */
export function parseBinary(frame: ArrayBuffer): ServerBinary | undefined {
  if (frame.byteLength < 1) return undefined;
  const view = new DataView(frame);
  const kind = view.getUint8(0);
  if (kind === 1 && frame.byteLength >= messageHead) {
    return {
      op: "message",
      subscription: view.getUint32(1, true),
      timeNs: view.getBigUint64(5, true),
      payload: new Uint8Array(frame, messageHead),
    };
  }
  if (kind === 2 && frame.byteLength >= 9) return { op: "time", timeNs: view.getBigUint64(1, true) };
  if (kind === 3 && frame.byteLength >= replyHead) {
    const start = replyHead + view.getUint32(9, true); // after the name of the encoding
    if (start > frame.byteLength) return undefined;
    return { op: "reply", service: view.getUint32(1, true), call: view.getUint32(5, true), payload: new Uint8Array(frame, start) };
  }
  return undefined;
}

export function publishFrame(channel: number, payload: Uint8Array): Uint8Array<ArrayBuffer> {
  const frame = new Uint8Array(5 + payload.length);
  const view = new DataView(frame.buffer);
  view.setUint8(0, 1);
  view.setUint32(1, channel, true);
  frame.set(payload, 5);
  return frame;
}

export function callFrame(service: number, call: number, payload: Uint8Array): Uint8Array<ArrayBuffer> {
  const encoding = new TextEncoder().encode("cdr");
  const frame = new Uint8Array(replyHead + encoding.length + payload.length);
  const view = new DataView(frame.buffer);
  view.setUint8(0, 2);
  view.setUint32(1, service, true);
  view.setUint32(5, call, true);
  view.setUint32(9, encoding.length, true);
  frame.set(encoding, replyHead);
  frame.set(payload, replyHead + encoding.length);
  return frame;
}
