// SPDX-License-Identifier: Apache-2.0
/** Parameters of the components, with their ranges if the component describes them. Shown if the server offers parameters. */
import type { Order } from "../link/events.ts";
import type { Parameter, ParameterValue } from "../link/wire.ts";
import { h, setText } from "../ui/dom.ts";
import { isListed, nodeOf, rangeText, readValue, type Descriptor } from "./parameter_values.ts";

type Call = (service: string, request: unknown) => Promise<unknown>;

class Row {
  #input: HTMLInputElement;
  #note = h("small");
  element: HTMLElement;
  #value: ParameterValue | undefined;
  #isReadOnly = false;
  #isWaiting = false; // for the server to say what a changed value is now

  constructor(
    label: string,
    readonly isAllowed: () => boolean,
    readonly set: (value: ParameterValue) => void,
  ) {
    this.#input = h("input", { spellcheck: false, "aria-label": label });
    this.#input.onchange = () => this.#change();
    this.element = h("label.parameter", {}, h("span", {}, label, this.#note), this.#input);
  }

  show(value: ParameterValue | undefined): void {
    this.#value = value;
    this.#input.disabled = this.#isReadOnly || !this.isAllowed();
    this.#input.type = typeof value === "boolean" ? "checkbox" : "text";
    if (typeof value === "boolean") this.#input.checked = value;
    else if (this.#isWaiting || document.activeElement !== this.#input) this.#input.value = typeof value === "string" ? value : JSON.stringify(value ?? "");
    this.#wait(false);
  }

  describe(descriptor: Descriptor): void {
    setText(this.#note, rangeText(descriptor));
    this.#isReadOnly = descriptor.read_only;
    this.show(this.#value);
  }

  #change(): void {
    const value = typeof this.#value === "boolean" ? this.#input.checked : readValue(this.#input.value, this.#value);
    this.#input.setCustomValidity(value === undefined ? "not a value of this parameter's type" : "");
    this.#input.reportValidity();
    if (value === undefined) return;
    this.#wait(true);
    this.set(value);
  }

  #wait(isWaiting: boolean): void {
    this.#isWaiting = isWaiting;
    this.element.classList.toggle("waiting", isWaiting);
  }
}

export class ParametersPanel {
  #rows = new Map<string, Row>();
  #nodes = new Map<string, HTMLElement>();
  #list = h("div.parameters");
  #maySet = false;

  constructor(
    readonly element: HTMLElement,
    readonly order: (order: Order) => void,
    readonly call: Call,
  ) {
    this.element.hidden = true;
    element.append(h("h3", {}, "Parameters"), this.#list);
  }

  setAllowed(mayRead: boolean, maySet: boolean): void {
    this.element.hidden = !mayRead;
    this.#maySet = maySet;
    if (mayRead) this.order({ kind: "parameters" });
  }

  show(parameters: Parameter[]): void {
    const added = new Set<string>();
    for (const { name, value, type } of parameters) {
      if (!isListed(name)) continue;
      let row = this.#rows.get(name);
      if (!row) {
        row = this.#add(name, type);
        added.add(nodeOf(name).node);
      }
      row.show(value);
    }
    for (const node of added) void this.#describe(node);
  }

  #add(name: string, type: string | undefined): Row {
    const { node, parameter } = nodeOf(name);
    let group = this.#nodes.get(node);
    if (!group) {
      group = h("details.component", {}, h("summary", {}, h("b", {}, node)));
      this.#nodes.set(node, group);
      this.#list.append(group);
    }
    const set = (value: ParameterValue) => this.order({ kind: "setParameter", parameter: { name, value, ...(type !== undefined && { type }) } });
    const row = new Row(parameter, () => this.#maySet, set);
    this.#rows.set(name, row);
    group.append(row.element);
    return row;
  }

  async #describe(node: string): Promise<void> {
    const rows = [...this.#rows].filter(([name]) => nodeOf(name).node === node);
    const names = rows.map(([name]) => nodeOf(name).parameter);
    try {
      const { descriptors } = (await this.call(`${node}/describe_parameters`, { names })) as { descriptors: Descriptor[] };
      descriptors.forEach((descriptor, i) => rows[i]?.[1].describe(descriptor));
    } catch {
      // Without the service the ranges stay unknown; the component still checks what is set.
    }
  }
}
