// SPDX-License-Identifier: Apache-2.0
/** Services without arguments as buttons, and those that switch something on and off. Shown if the server offers them. */
import { h, setText } from "../ui/dom.ts";

type Call = (service: string, request: unknown) => Promise<unknown>;

export class ActionsPanel {
  #list = h("div.actions");
  #answer = h("p.answer", { "aria-live": "polite" });

  constructor(
    readonly element: HTMLElement,
    readonly call: Call,
  ) {
    element.hidden = true;
    element.append(h("h3", {}, "Actions"), this.#list, this.#answer);
  }

  offer(services: { name: string; type: string }[]): void {
    const buttons = services.flatMap(({ name, type }) => {
      const label = name.replace(/^\//, "").replaceAll("_", " ");
      if (type.endsWith("std_srvs/srv/Trigger")) return [this.#button(label, name, {})];
      if (!type.endsWith("std_srvs/srv/SetBool")) return [];
      return [this.#button(`${label}: on`, name, { data: true }), this.#button(`${label}: off`, name, { data: false })];
    });
    this.element.hidden = buttons.length === 0;
    this.#list.replaceChildren(...buttons);
  }

  #button(label: string, service: string, request: unknown): HTMLElement {
    return h("button", { onclick: () => void this.#run(label, service, request) }, label);
  }

  async #run(label: string, service: string, request: unknown): Promise<void> {
    setText(this.#answer, `${label} …`);
    try {
      const { success, message } = (await this.call(service, request)) as { success: boolean; message: string };
      setText(this.#answer, `${label}: ${success ? "done" : "refused"}${message ? `, ${message}` : ""}`);
    } catch (error) {
      setText(this.#answer, `${label}: ${(error as Error).message}`);
    }
  }
}
