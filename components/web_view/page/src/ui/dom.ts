// SPDX-License-Identifier: Apache-2.0

type Child = Node | string | undefined;

/** An element with class, attributes and children: h("button.primary", { onclick }, "Set"). */
export function h<Name extends keyof HTMLElementTagNameMap>(
  what: Name | `${Name}.${string}`,
  properties: Partial<Omit<HTMLElementTagNameMap[Name], "style">> & { [aria: `aria-${string}`]: string } = {},
  ...children: Child[]
): HTMLElementTagNameMap[Name] {
  const [name, ...classes] = what.split(".");
  const element = document.createElement(name as Name);
  element.classList.add(...classes);
  for (const [key, value] of Object.entries(properties)) {
    if (key.startsWith("aria-")) element.setAttribute(key, String(value));
    else (element as unknown as Record<string, unknown>)[key] = value;
  }
  element.append(...children.filter((child): child is Node | string => child !== undefined));
  return element;
}

export function byId<Type extends HTMLElement = HTMLElement>(id: string): Type {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page has no element ${id}`);
  return element as Type;
}

/** Sets a text only if it differs, so that screen readers and selections are not disturbed. */
export function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** m:ss, with hours if there are any. */
export function clock(seconds: number): string {
  const whole = Math.max(0, Math.floor(seconds));
  const two = (value: number) => String(value).padStart(2, "0");
  const hours = Math.floor(whole / 3600);
  const minutes = Math.floor((whole % 3600) / 60);
  return hours > 0 ? `${hours}:${two(minutes)}:${two(whole % 60)}` : `${minutes}:${two(whole % 60)}`;
}
