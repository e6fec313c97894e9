// SPDX-License-Identifier: Apache-2.0
/** Pause, speed and position of a bag that is played. Shown if the server offers the services of a player. */
import { h } from "../ui/dom.ts";

type Call = (service: string, request: unknown) => Promise<unknown>;

const rates = [0.25, 0.5, 1, 2, 4, 8];
const step_s = 10;

const icon = (path: string) => {
  const span = document.createElement("span");
  span.innerHTML = `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${path}"/></svg>`;
  return span.firstElementChild!;
};

export class PlayerPanel {
  time_s: number | undefined; // of the recording
  isPaused = false;
  #node: string | undefined;
  #toggle = h("button.icon", { onclick: () => void this.toggle() });
  #rate = h("select", { "aria-label": "Speed", onchange: () => void this.#setRate(Number(this.#rate.value)) });

  constructor(
    readonly element: HTMLElement,
    readonly call: Call,
  ) {
    const jump = (seconds: number, path: string, label: string) => h("button.icon", { onclick: () => void this.#jump(seconds), "aria-label": label, title: label }, icon(path));
    element.append(
      jump(-step_s, "M11 6 4 12l7 6ZM20 6l-7 6 7 6Z", `${step_s} s back`),
      this.#toggle,
      jump(step_s, "M13 6l7 6-7 6ZM4 6l7 6-7 6Z", `${step_s} s on`),
      this.#rate,
    );
  }

  offer(services: { name: string; type: string }[]): void {
    const pause = services.find(({ type }) => type === "rosbag2_interfaces/srv/Pause");
    this.element.hidden = !pause;
    const node = pause?.name.replace(/\/pause$/, "");
    if (node === this.#node) return;
    this.#node = node;
    this.isPaused = false;
    void this.#refresh();
  }

  async toggle(): Promise<void> {
    await this.#ask("toggle_paused", {});
    await this.#refresh();
  }

  async #jump(seconds: number): Promise<void> {
    if (this.time_s === undefined) return;
    const to = this.time_s + seconds;
    await this.#ask("seek", { time: { sec: Math.floor(to), nanosec: Math.floor((to % 1) * 1e9) } });
  }

  async #setRate(rate: number): Promise<void> {
    await this.#ask("set_rate", { rate });
    await this.#refresh();
  }

  /** Shows the state that the player reports, not the one requested. */
  async #refresh(): Promise<void> {
    const { paused } = ((await this.#ask("is_paused", {})) ?? { paused: false }) as { paused: boolean };
    const { rate } = ((await this.#ask("get_rate", {})) ?? { rate: 1 }) as { rate: number };
    this.isPaused = paused;
    this.#toggle.replaceChildren(icon(paused ? "M7 5l12 7-12 7Z" : "M8 5v14M16 5v14"));
    this.#toggle.setAttribute("aria-label", paused ? "Play" : "Pause");
    this.#toggle.title = `${paused ? "Play" : "Pause"} (space)`;
    const all = [...new Set([...rates, rate])].sort((a, b) => a - b);
    this.#rate.replaceChildren(...all.map((value) => h("option", { value: String(value), selected: value === rate }, `${value}×`)));
  }

  async #ask(service: string, request: unknown): Promise<unknown> {
    if (this.#node === undefined) return undefined;
    try {
      return await this.call(`${this.#node}/${service}`, request);
    } catch {
      return undefined; // the player is gone, which the list of services will tell
    }
  }
}
