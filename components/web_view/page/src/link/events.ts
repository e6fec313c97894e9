// SPDX-License-Identifier: Apache-2.0
/** What the page and the thread that holds the connection tell each other. */
import type { Role } from "./roles.ts";
import type { Parameter } from "./wire.ts";

/** From the page. */
export type Order =
  | { kind: "open"; url: string }
  | { kind: "retry" }
  | { kind: "images"; topics: string[] }
  | { kind: "publish"; topic: string; schemaName: string; message: unknown }
  | { kind: "parameters" }
  | { kind: "setParameter"; parameter: Parameter }
  | { kind: "call"; call: number; service: string; request: unknown };

/** A message of a topic with a role. */
export interface RoleMessage {
  role: Role;
  topic: string;
  message: unknown;
}

export interface Traffic {
  bytes: number; // received since the page was opened
  unknown: { topic: string; type: string; why: string }[]; // topics that are wanted but cannot be decoded
  undecodable: number; // messages that did not fit their definition
}

/** From the connection's thread. */
export type Happening =
  | { kind: "connecting"; attempt: number }
  | { kind: "open"; server: string; capabilities: string[]; isAnotherRun: boolean; range_s?: [number, number] } // of what is played
  | { kind: "lost"; wasOpen: boolean; retry_ms: number }
  | { kind: "topics"; topics: { topic: string; type: string }[] }
  | { kind: "services"; services: { name: string; type: string }[] }
  | { kind: "messages"; messages: RoleMessage[] }
  | { kind: "image"; topic: string; frame: string; stamp_s: number; bitmap: ImageBitmap }
  | { kind: "imageFault"; topic: string; why: string }
  | { kind: "status"; level: number; message: string }
  | { kind: "parameters"; parameters: Parameter[] }
  | { kind: "reply"; call: number; response?: unknown; fault?: string }
  | { kind: "time"; time_s: number } // of the recording that is played
  | { kind: "traffic"; traffic: Traffic };
