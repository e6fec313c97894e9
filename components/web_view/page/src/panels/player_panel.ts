// SPDX-License-Identifier: Apache-2.0
/** Pause, speed and position of a bag that is played. Shown if the server offers the services of a player. */
import { clock, h, setText } from "../ui/dom.ts";

type Call = (service: string, request: unknown) => Promise<unknown>;

const rates = [0.25, 0.5, 1, 2, 4, 8];
const step_s = 10;
const settled_ms = 400; // after a move, until the times that the server tells are those after it

const icon = (path: string) => {
  const span = document.createElement("span");
  span.innerHTML = `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${path}"/></svg>`;
  return span.firstElementChild!;
};

export class PlayerPanel {
  isPaused = false;
  range_s: [number, number] | undefined; // of the whole bag; before offer()
  rate = 1;
  #time_s: number | undefined; // of the recording
  #first_s = Infinity; // range of the slider: the whole bag, if known, and the times received
  #last_s = -Infinity;
  #told_s: number | undefined; // the newest
  #asked_s: number | undefined; // the bag is being moved there
  #moved_ms = -Infinity;
  #isDragged = false;
  #node: string | undefined;
  #offered: string[] = []; // services of the node
  #toggle = h("button.icon", { onclick: () => void this.toggle() });
  #rate = h("select", { "aria-label": "Speed", onchange: () => void this.#setRate(Number(this.#rate.value)) });
  #slider = h("input", { type: "range", step: "0.1", "aria-label": "Position in what was played" });
  #state = h("span.state", { role: "status" });

  constructor(
    readonly element: HTMLElement,
    readonly call: Call,
  ) {
    element.setAttribute("role", "group");
    element.setAttribute("aria-label", "Player of the bag");
    const jump = (seconds: number, path: string, label: string, key: string) =>
      h("button.icon", { onclick: () => this.jump(seconds), "aria-label": label, title: `${label} (${key})` }, icon(path));
    this.#slider.oninput = () => {
      this.#isDragged = true;
      this.#show(Number(this.#slider.value));
    };
    this.#slider.onchange = () => {
      this.#isDragged = false;
      void this.#moveTo(Number(this.#slider.value));
    };
    element.append(
      jump(-step_s, "M11 6 4 12l7 6ZM20 6l-7 6 7 6Z", `${step_s} s back`, ","),
      this.#toggle,
      jump(step_s, "M13 6l7 6-7 6ZM4 6l7 6-7 6Z", `${step_s} s on`, "."),
      this.#slider,
      this.#rate,
      this.#state,
    );
  }

  get time_s(): number | undefined {
    return this.#time_s;
  }

  /** From the server. */
  set time_s(time_s: number | undefined) {
    if (time_s === undefined) return;
    this.#told_s = time_s;
    if (performance.now() - this.#moved_ms < settled_ms) return;
    // A move before or after the bag ends at its begin or end.
    if (this.#asked_s === this.#first_s && time_s > this.#first_s) this.#first_s = time_s;
    if (this.#asked_s === this.#last_s && time_s < this.#last_s) this.#last_s = time_s;
    this.#asked_s = undefined;
    this.#time_s = time_s;
    this.#first_s = Math.min(this.#first_s, time_s);
    this.#last_s = Math.max(this.#last_s, time_s);
    if (!this.#isDragged) this.#show(time_s);
  }

  offer(services: { name: string; type: string }[]): void {
    const seek = services.find(({ type }) => type === "rosbag2_interfaces/srv/Seek"); // a recorder offers Pause, too
    this.element.hidden = !seek;
    const node = seek?.name.replace(/\/seek$/, "");
    const before = this.#offered;
    this.#offered = node === undefined ? [] : services.map(({ name }) => name).filter((name) => name.startsWith(`${node}/`));
    if (node !== this.#node) {
      this.#node = node;
      this.isPaused = false;
      [this.#first_s, this.#last_s] = this.range_s ?? [Infinity, -Infinity];
    } else if (this.#offered.every((name) => before.includes(name))) return;
    void this.#refresh();
  }

  async toggle(): Promise<void> {
    await this.#ask("toggle_paused", {});
    await this.#refresh();
  }

  jump(seconds: number): void {
    if (this.#time_s !== undefined) void this.#moveTo(this.#time_s + seconds);
  }

  /** To the next speed in the list. */
  faster(by: 1 | -1): void {
    const next = by > 0 ? rates.find((rate) => rate > this.rate) : rates.filter((rate) => rate < this.rate).at(-1);
    if (next !== undefined) void this.#setRate(next);
  }

  async #moveTo(to: number): Promise<void> {
    if (this.#node === undefined) return;
    if (this.range_s) to = Math.min(Math.max(to, this.range_s[0]), this.range_s[1]);
    this.#moved_ms = performance.now();
    this.#told_s = undefined;
    setTimeout(() => (this.time_s = this.#told_s), settled_ms + 1); // while paused, the server sends its time only once
    this.#time_s = this.#asked_s = to; // so that the next jump starts there
    this.#first_s = Math.min(this.#first_s, to);
    this.#last_s = Math.max(this.#last_s, to);
    this.#show(to);
    await this.#ask("seek", { time: { sec: Math.floor(to), nanosec: Math.floor((to % 1) * 1e9) } });
  }

  async #setRate(rate: number): Promise<void> {
    await this.#ask("set_rate", { rate });
    await this.#refresh();
  }

  #show(time_s: number): void {
    const { min, max, value } = this.#slider;
    const [first, last, now] = [this.#first_s, this.#last_s, time_s].map((time) => time.toFixed(1)) as [string, string, string];
    if (min !== first) this.#slider.min = first;
    if (max !== last) this.#slider.max = last;
    if (value !== now && !this.#isDragged) this.#slider.value = now;
    const at = clock(time_s - this.#first_s);
    this.#slider.setAttribute("aria-valuetext", `${at} of ${clock(this.#last_s - this.#first_s)}`);
    this.#slider.title = at;
  }

  /** Shows the state that the player reports, not the one requested. */
  async #refresh(): Promise<void> {
    const { paused } = ((await this.#ask("is_paused", {})) ?? { paused: false }) as { paused: boolean };
    const { rate } = ((await this.#ask("get_rate", {})) ?? { rate: 1 }) as { rate: number };
    this.isPaused = paused;
    this.rate = rate;
    this.#toggle.replaceChildren(icon(paused ? "M7 5l12 7-12 7Z" : "M8 5v14M16 5v14"));
    this.#toggle.setAttribute("aria-label", paused ? "Play" : "Pause");
    this.#toggle.title = `${paused ? "Play" : "Pause"} (space)`;
    setText(this.#state, paused ? "paused" : "playing");
    const all = [...new Set([...rates, rate])].sort((a, b) => a - b);
    this.#rate.replaceChildren(...all.map((value) => h("option", { value: String(value), selected: value === rate }, `${value}×`)));
  }

  async #ask(service: string, request: unknown): Promise<unknown> {
    const name = `${this.#node}/${service}`;
    if (!this.#offered.includes(name)) return undefined;
    try {
      return await this.call(name, request);
    } catch {
      return undefined; // the player is gone, which the list of services will tell
    }
  }
}
