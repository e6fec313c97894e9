// SPDX-License-Identifier: Apache-2.0
/** Services without arguments as buttons, and those that switch something on and off. Shown if the server offers them. */
import { h, setText } from "../ui/dom.ts";

type Call = (service: string, request: unknown) => Promise<unknown>;

export class ActionsPanel {
  #list = h("div.actions");
  #answer = h("p.answer", { "aria-live": "polite" });
  #underWay = new Set<string>(); // services that have not answered; their buttons may be replaced meanwhile

  constructor(
    readonly element: HTMLElement,
    readonly call: Call,
  ) {
    element.hidden = true;
    element.append(h("h3", {}, "Actions"), this.#list, this.#answer);
  }

  offer(services: { name: string; type: string }[]): void {
    const buttons = services.flatMap(({ name, type }) => {
      const label = labelOf(name);
      if (type.endsWith("std_srvs/srv/Trigger")) return [this.#button(label, name, {})];
      if (!type.endsWith("std_srvs/srv/SetBool")) return [];
      return [this.#button(`${label}: on`, name, { data: true }), this.#button(`${label}: off`, name, { data: false })];
    });
    this.element.hidden = buttons.length === 0;
    this.#list.replaceChildren(...buttons);
    this.#update();
  }

  #button(label: string, service: string, request: unknown): HTMLElement {
    return h("button", { value: service, onclick: () => void this.#run(label, service, request) }, label);
  }

  #update(): void {
    for (const button of this.#list.querySelectorAll("button")) button.disabled = this.#underWay.has(button.value);
  }

  async #run(label: string, service: string, request: unknown): Promise<void> {
    setText(this.#answer, `${label} …`);
    this.#underWay.add(service);
    this.#update();
    try {
      const { success, message } = (await this.call(service, request)) as { success: boolean; message: string };
      setText(this.#answer, `${label}: ${success ? "done" : "refused"}${message ? `, ${message}` : ""}`);
    } catch (error) {
      setText(this.#answer, `${label}: ${(error as Error).message}`);
    }
    this.#underWay.delete(service);
    this.#update();
  }
}

/** Of a robot in a fleet: "Save the map of robot1". */
function labelOf(service: string): string {
  const save = /^\/(?:(.+)\/)?landmark_store\/save$/.exec(service);
  if (save) return save[1] ? `Save the map of ${save[1]}` : "Save the map";
  return service.replace(/^\//, "").replaceAll("_", " ");
}
