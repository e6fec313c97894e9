// SPDX-License-Identifier: Apache-2.0
/** A snapshot as one HTML file, with everything it needs: to send to somebody, to open without a network. */
import type { RecordedDrive } from "../model/recorded_drive.ts";
import type { Snapshot } from "../model/snapshot.ts";

const id = "snapshot";

/** Text that may stand in a script element. */
export const inScript = (text: string) => text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");

async function textOf(file: string): Promise<string> {
  const response = await fetch(file);
  if (!response.ok) throw new Error(`${file}: ${response.status}`);
  return response.text();
}

export async function snapshotPage(snapshot: Snapshot): Promise<Blob> {
  const [html, style, script] = await Promise.all(["./index.html", "./style.css", "./page.js"].map(textOf));
  const data = `<script type="application/json" id="${id}">${JSON.stringify(snapshot).replaceAll("<", "\\u003c")}</script>`;
  // Functions, because $ in a replacement text has a meaning.
  const page = html!
    .replace(/<link rel="(icon|manifest)"[^>]*>\s*/g, "")
    .replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${style!}</style>`)
    .replace(/<script[^>]*src="page.js"[^>]*><\/script>/, () => "")
    .replace("</body>", () => `${data}<script>${inScript(script!)}</script></body>`);
  return new Blob([page], { type: "text/html" });
}

function included(element: HTMLElement | null): unknown {
  return element ? JSON.parse(element.textContent ?? "") : undefined;
}

/** The snapshot in this page, if it is one. */
export const includedSnapshot = () => included(document.getElementById(id)) as Snapshot | undefined;
/** The recorded drive in this page, if it is one. */
export const includedDrive = () => included(document.getElementById("recorded-drive")) as RecordedDrive | undefined;

export function download(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
