// SPDX-License-Identifier: Apache-2.0
/** What /diagnostics says of each component. */
import type { DiagnosticArray } from "./messages.ts";

export interface Input {
  topic: string;
  rate_hz?: number;
  latency_ms?: number; // from its arrival until it was handled, p95
  dropped: number;
}

export interface Component {
  name: string;
  level: number; // 0 ok, 1 warning, 2 error
  message: string;
  inputs: Input[];
  stages: { name: string; mean_ms: number; p95_ms: number }[];
  cpu_percent?: number;
  memory_mb?: number;
  other: { key: string; value: string }[];
}

const prefix = "panvo: ";

function number(text: string, pattern: RegExp): number | undefined {
  const found = pattern.exec(text)?.[1];
  return found === undefined ? undefined : Number(found);
}

/** Components with the values that the page knows how to read; the others are kept as texts. */
export function componentsOf(array: DiagnosticArray): Component[] {
  return array.status.map(({ name, level, message, values }) => {
    const component: Component = {
      name: name.startsWith(prefix) ? name.slice(prefix.length) : name,
      level,
      message,
      inputs: [],
      stages: [],
      other: [],
    };
    const inputs = new Map<string, Input>();
    const input = (topic: string): Input => {
      let found = inputs.get(topic);
      if (!found) inputs.set(topic, (found = { topic, dropped: 0 }));
      return found;
    };
    for (const { key, value } of values) read(component, input, key, value);
    component.inputs = [...inputs.values()];
    return component;
  });
}

function read(component: Component, input: (topic: string) => Input, key: string, value: string): void {
  const cut = key.lastIndexOf(" ");
  const subject = key.slice(0, Math.max(0, cut));
  const kind = key.slice(cut + 1);
  if (kind === "rate" && value.endsWith("Hz")) {
    input(subject).rate_hz = number(value, /([\d.]+) Hz/) ?? 0;
  } else if (kind === "latency") {
    const latency = number(value, /p95 ([\d.]+) ms/);
    if (latency !== undefined) input(subject).latency_ms = latency;
  } else if (kind === "messages" && value.includes("dropped")) {
    input(subject).dropped = number(value, /(\d+) dropped/) ?? 0;
  } else if (kind === "time" && value.includes("mean")) {
    component.stages.push({ name: subject, mean_ms: number(value, /mean ([\d.]+) ms/) ?? 0, p95_ms: number(value, /p95 ([\d.]+) ms/) ?? 0 });
  } else if (/^cpu$/i.test(key) && value.includes("%")) {
    component.cpu_percent = number(value, /([\d.]+) ?%/) ?? 0;
  } else if (/^memory$/i.test(key) && value.includes("MB")) {
    component.memory_mb = number(value, /([\d.]+) MB/) ?? 0;
  } else {
    component.other.push({ key, value });
  }
}

/** p95 of the input that is handled latest, ms; undefined if there is none. */
export function latencyOf({ inputs }: Component): number | undefined {
  const latencies = inputs.map(({ latency_ms }) => latency_ms).filter((one) => one !== undefined);
  return latencies.length > 0 ? Math.max(...latencies) : undefined;
}

export const droppedBy = ({ inputs }: Component): number => inputs.reduce((sum, { dropped }) => sum + dropped, 0);
