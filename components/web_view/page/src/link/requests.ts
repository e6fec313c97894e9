// SPDX-License-Identifier: Apache-2.0
/** Parameters and services of a server. */
import { encoded, isEmpty, readerOf } from "./codec.ts";
import type { Happening, Order } from "./events.ts";
import { callFrame, type ServerBinary, type ServerText, type Service } from "./wire.ts";

type Reply = Extract<ServerBinary, { op: "reply" }>;

export class Requests {
  #services = new Map<number, Service>();
  #open = new Map<number, Service>(); // calls without an answer yet

  constructor(
    readonly send: (data: string | Uint8Array<ArrayBuffer>) => void,
    readonly emit: (happening: Happening) => void,
  ) {}

  /** After a connection ended: what was asked will not be answered. */
  clear(): void {
    for (const call of this.#open.keys()) this.emit({ kind: "reply", call, fault: "the connection was lost" });
    this.#open.clear();
    this.#services.clear();
  }

  obey(order: Extract<Order, { kind: "parameters" | "setParameter" | "call" }>): void {
    if (order.kind === "parameters") {
      this.send(JSON.stringify({ op: "getParameters", parameterNames: [], id: "all" }));
    } else if (order.kind === "setParameter") {
      this.send(JSON.stringify({ op: "setParameters", parameters: [order.parameter], id: order.parameter.name }));
    } else {
      this.#call(order.call, order.service, order.request);
    }
  }

  handle(message: ServerText): void {
    if (message.op === "parameterValues") {
      this.emit({ kind: "parameters", parameters: message.parameters });
    } else if (message.op === "advertiseServices") {
      for (const service of message.services) this.#services.set(service.id, service);
      this.#tellServices();
    } else if (message.op === "unadvertiseServices") {
      for (const id of message.serviceIds) this.#services.delete(id);
      this.#tellServices();
    } else if (message.op === "serviceCallFailure") {
      this.#open.delete(message.callId);
      this.emit({ kind: "reply", call: message.callId, fault: message.message });
    }
  }

  reply({ call, payload }: Reply): void {
    const service = this.#open.get(call);
    if (!service) return;
    this.#open.delete(call);
    try {
      const schema = service.response?.schema ?? service.responseSchema ?? "";
      const response = isEmpty(schema) ? {} : readerOf(schema).readMessage(payload);
      this.emit({ kind: "reply", call, response });
    } catch (error) {
      this.emit({ kind: "reply", call, fault: (error as Error).message });
    }
  }

  #call(call: number, name: string, request: unknown): void {
    const service = [...this.#services.values()].find((one) => one.name === name);
    try {
      if (!service) throw new Error(`unknown service ${name}`);
      const bytes = encoded(service.request?.schema ?? service.requestSchema ?? "", request);
      this.#open.set(call, service);
      this.send(callFrame(service.id, call, bytes));
    } catch (error) {
      this.emit({ kind: "reply", call, fault: (error as Error).message });
    }
  }

  #tellServices(): void {
    this.emit({ kind: "services", services: [...this.#services.values()].map(({ name, type }) => ({ name, type })) });
  }
}
