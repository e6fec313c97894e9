// SPDX-License-Identifier: Apache-2.0
/** Keys of the page. Those that move the map are in gestures.ts. */

export function listenForShortcuts(calls: Record<string, () => void>): void {
  addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || /^(input|select|textarea)$/i.test(target.tagName)) return;
    if (document.querySelector("dialog[open]")) return;
    if (event.key === " " && target.closest("button, summary, a")) return; // presses it
    const call = calls[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!call) return;
    event.preventDefault();
    call();
  });
}
