// SPDX-License-Identifier: Apache-2.0
/** The report of a recorded drive, a page of its own over this one. */
import { byId } from "../ui/dom.ts";

export class ReportPanel {
  #dialog = byId<HTMLDialogElement>("report");
  #button = byId("report-button");

  show(html: string): void {
    const frame = this.#dialog.querySelector("iframe")!;
    frame.onload = () =>
      frame.contentWindow!.addEventListener("keydown", ({ key }) => {
        if (key === "Escape") this.close(); // keys pressed in a frame do not reach its dialog
      });
    frame.srcdoc = html;
    this.#button.hidden = false;
  }

  open(): void {
    if (!this.#button.hidden) this.#dialog.showModal();
  }

  close(): void {
    this.#dialog.close();
  }
}
