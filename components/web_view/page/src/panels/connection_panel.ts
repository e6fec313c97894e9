// SPDX-License-Identifier: Apache-2.0
/** The connection: whether there is one, when the next attempt is made, and the dialog for address and token. */
import { serverAddress } from "../link/address.ts";
import type { Known } from "../model/state_line.ts";
import { byId, setText } from "../ui/dom.ts";

const tokenKey = "panvo token";

export class ConnectionPanel {
  #dialog = byId<HTMLDialogElement>("connect");
  #token = byId<HTMLInputElement>("token");
  #button = byId("link");
  #retry_at = 0;
  state: NonNullable<Known["link"]> = "connecting";
  token: string;

  constructor(readonly onOpen: (address: string) => void) {
    this.token = new URL(location.href).searchParams.get("token") ?? sessionStorage.getItem(tokenKey) ?? "";
    this.#button.onclick = () => this.ask("");
    byId<HTMLFormElement>("connect-form").onsubmit = () => {
      this.token = this.#token.value.trim();
      sessionStorage.setItem(tokenKey, this.token);
      this.open();
    };
    byId("connect-cancel").onclick = () => this.#dialog.close();
  }

  open(): void {
    this.onOpen(this.address);
  }

  get address(): string {
    return serverAddress(location.href, this.token);
  }

  ask(why: string): void {
    if (this.#dialog.open) return;
    setText(byId("connect-why"), why);
    this.#token.value = this.token;
    this.#dialog.showModal();
  }

  connecting(): void {
    this.#show("connecting", "Connecting");
  }

  opened(): void {
    this.#dialog.close();
    this.#show("open", "Live");
  }

  async lost(wasOpen: boolean, retry_ms: number): Promise<void> {
    this.state = "lost";
    this.#retry_at = performance.now() + retry_ms;
    this.update();
    if (!wasOpen && (await this.#isRefused())) {
      this.#show("lost", "Token needed");
      this.ask("The server asks for a token. It was shown when the view was started.");
    }
  }

  snapshot(taken: string): void {
    this.#without(`Snapshot of ${new Date(taken).toLocaleString()}`);
  }

  recorded(title: string): void {
    this.#button.title = title;
    this.#without("Recorded drive");
  }

  #without(text: string): void {
    this.#button.setAttribute("disabled", "");
    this.#show("snapshot", text);
  }

  /** Counts down to the next attempt. */
  update(): void {
    if (this.state !== "lost") return;
    const seconds = Math.max(0, Math.ceil((this.#retry_at - performance.now()) / 1000));
    this.#show("lost", `Server lost, again in ${seconds} s`);
  }

  #show(state: typeof this.state, text: string): void {
    this.state = state;
    document.body.dataset.link = state;
    setText(byId("link-text"), text);
  }

  /** WebSocket does not say why it failed; a request for the page does, if it is the same server. */
  async #isRefused(): Promise<boolean> {
    const address = new URL(this.address.replace(/^ws/, "http"));
    if (address.host !== location.host) return false;
    try {
      return (await fetch(address, { cache: "no-store" })).status === 401;
    } catch {
      return false;
    }
  }
}
