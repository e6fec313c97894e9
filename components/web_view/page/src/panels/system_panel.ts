// SPDX-License-Identifier: Apache-2.0
/** The connection and the components: how they are, what they take. */
import { droppedBy, type Component } from "../model/components.ts";
import type { Drive } from "../model/drive.ts";
import type { Level } from "../model/state_line.ts";
import type { Traffic } from "../link/events.ts";
import { h, setText } from "../ui/dom.ts";
import { glyph, setGlyph } from "../ui/glyph.ts";

const levels: Level[] = ["good", "caution", "bad"];

class ComponentRow {
  #glyph = glyph("idle");
  #message = h("small");
  #load = h("span.load");
  #details = h("div.details");
  element: HTMLElement;

  constructor(name: string) {
    const words = h("span", {}, h("b", {}, name), this.#message);
    this.element = h("details.component", {}, h("summary", {}, this.#glyph, words, this.#load), this.#details);
  }

  update(component: Component): void {
    const { level, message, cpu_percent, memory_mb, inputs, stages, other } = component;
    setGlyph(this.#glyph, levels[level] ?? "idle");
    const dropped = droppedBy(component);
    setText(this.#message, dropped > 0 ? `${message}; ${dropped} dropped in all` : message);
    const load = [cpu_percent !== undefined && `${Math.round(cpu_percent)} % CPU`, memory_mb !== undefined && `${Math.round(memory_mb)} MB`];
    setText(this.#load, load.filter(Boolean).join(" · "));
    if (!(this.element as HTMLDetailsElement).open) return;
    const rows = [
      ...inputs.map(({ topic, rate_hz, latency_ms, dropped: lost }) => {
        const latency = latency_ms === undefined ? "" : `, handled within ${latency_ms.toFixed(1)} ms (p95)`;
        return [topic, `${(rate_hz ?? 0).toFixed(1)} Hz${latency}${lost > 0 ? `, ${lost} dropped` : ""}`];
      }),
      ...stages.map(({ name, mean_ms, p95_ms }) => [name, `${mean_ms.toFixed(1)} ms, p95 ${p95_ms.toFixed(1)} ms`]),
      ...other.map(({ key, value }) => [key, value]),
    ];
    this.#details.replaceChildren(h("dl", {}, ...rows.flatMap(([name, text]) => [h("dt", {}, name), h("dd", {}, text)])));
  }
}

export class SystemPanel {
  #heading = h("h3", {}, "Connection");
  #connection = h("dl.facts");
  #components = h("div.components");
  #unknown = h("ul.unknown");
  #rows = new Map<string, ComponentRow>();
  #empty = h("p.empty", {}, "No component has published /diagnostics.");
  #facts: [string, string][] = [];
  #bytes = 0;
  #notice = "";

  constructor(
    readonly element: HTMLElement,
    readonly drive: Drive,
  ) {
    element.append(this.#heading, this.#connection, this.#unknown, h("h3", {}, "Components"), this.#empty, this.#components);
  }

  /** What the server says without being asked. */
  setNotice(text: string): void {
    this.#notice = text;
  }

  /** Called once a second. */
  setTraffic({ bytes, unknown, undecodable }: Traffic, server: string, address: string): void {
    const megabytes = Math.max(0, bytes - this.#bytes) / 1e6;
    this.#bytes = bytes;
    const problems = [unknown.length > 0 && `${unknown.length} topics of unknown type`, undecodable > 0 && `${undecodable} messages`];
    this.#facts = [
      ["Server", `${server}, ${address}`],
      ["Receiving", `${megabytes.toFixed(1)} MB/s`],
      ["Not decoded", problems.filter(Boolean).join(", ") || "nothing"],
      ...(this.#notice ? ([["Notice", this.#notice]] as [string, string][]) : []),
    ];
    this.#unknown.replaceChildren(...unknown.map(({ topic, type, why }) => h("li", {}, `${topic} (${type}): ${why}`)));
  }

  update(): void {
    this.#connection.replaceChildren(...this.#facts.flatMap(([name, text]) => [h("dt", {}, name), h("dd", {}, text)]));
    const { components } = this.drive;
    this.#empty.hidden = components.size > 0;
    this.#connection.hidden = this.#heading.hidden = this.#facts.length === 0; // without a server
    for (const [name, component] of [...components].sort(([a], [b]) => a.localeCompare(b))) {
      let row = this.#rows.get(name);
      if (!row) {
        this.#rows.set(name, (row = new ComponentRow(name)));
        this.#components.append(row.element);
      }
      row.update(component);
    }
  }
}
