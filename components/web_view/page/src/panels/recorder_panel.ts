// SPDX-License-Identifier: Apache-2.0
/** Starts and stops the recorders whose services the server offers. A player of bags can be paused, too, but it can also be moved. */
import { h, setText } from "../ui/dom.ts";

type Call = (service: string, request: unknown) => Promise<unknown>;
interface Service {
  name: string;
  type: string;
}

const poll_ms = 2000; // others may pause a recorder

class Row {
  #state = h("small", { role: "status" }, "…");
  #button: HTMLButtonElement;
  element: HTMLElement;
  #isPaused: boolean | undefined;
  #isAsking = false; // for a change, during which the state is polled, too

  constructor(
    readonly node: string,
    readonly call: Call,
  ) {
    this.#button = h("button", { disabled: true, onclick: () => void this.#toggle() }, "Record");
    this.element = h("div.recorder", {}, h("span", {}, h("b", {}, node.replace(/^\//, "")), this.#state), this.#button);
  }

  async refresh(): Promise<void> {
    try {
      this.#isPaused = ((await this.call(`${this.node}/is_paused`, {})) as { paused: boolean }).paused;
      setText(this.#state, this.#isPaused ? "paused" : "records");
    } catch (error) {
      this.#isPaused = undefined;
      setText(this.#state, (error as Error).message);
    }
    this.#button.disabled = this.#isAsking || this.#isPaused === undefined;
    setText(this.#button, this.#isPaused ? "Record" : "Pause");
  }

  async #toggle(): Promise<void> {
    this.#isAsking = this.#button.disabled = true;
    await this.call(`${this.node}/${this.#isPaused ? "resume" : "pause"}`, {}).catch(() => {}); // refresh() says what is wrong
    this.#isAsking = false;
    await this.refresh();
  }
}

export class RecorderPanel {
  #list = h("div.recorders");
  #rows: Row[] = [];
  #asked_ms = 0;

  constructor(
    readonly element: HTMLElement,
    readonly call: Call,
  ) {
    element.hidden = true;
    element.append(h("h3", {}, "Recording"), this.#list);
  }

  offer(services: Service[]): void {
    const nodes = recordersOf(services);
    this.element.hidden = nodes.length === 0;
    if (nodes.join() === this.#rows.map(({ node }) => node).join()) return;
    this.#rows = nodes.map((node) => new Row(node, this.call));
    this.#list.replaceChildren(...this.#rows.map(({ element }) => element));
    this.#asked_ms = 0;
  }

  update(): void {
    const now = performance.now();
    if (this.#rows.length === 0 || now - this.#asked_ms < poll_ms) return;
    this.#asked_ms = now;
    for (const row of this.#rows) void row.refresh();
  }
}

/** Nodes that can be paused but not moved. */
export function recordersOf(services: Service[]): string[] {
  const names = new Set(services.filter(({ type }) => type.startsWith("rosbag2_interfaces/srv/")).map(({ name }) => name));
  const nodes = [...names].filter((name) => name.endsWith("/is_paused")).map((name) => name.replace(/\/is_paused$/, ""));
  return nodes.filter((node) => names.has(`${node}/pause`) && names.has(`${node}/resume`) && !names.has(`${node}/seek`)).sort();
}
