// SPDX-License-Identifier: Apache-2.0
import type { ParameterValue } from "../link/wire.ts";

/** The part of rcl_interfaces/msg/ParameterDescriptor that is shown. */
export interface Descriptor {
  description: string;
  read_only: boolean;
  floating_point_range: { from_value: number; to_value: number }[];
  integer_range: { from_value: number | bigint; to_value: number | bigint }[];
}

/** "/panvo/localizer/integrity.risk": node and parameter. Nodes have no dots, but "qos_overrides./tf.depth" has slashes. */
export function nodeOf(name: string): { node: string; parameter: string } {
  const slash = name.split(".", 1)[0]!.lastIndexOf("/");
  return { node: name.slice(0, Math.max(0, slash)), parameter: name.slice(slash + 1) };
}

/** Whether to list a parameter. QoS overrides, several per topic, are not listed. */
export const isListed = (name: string): boolean => !nodeOf(name).parameter.startsWith("qos_overrides.");

export function rangeText({ description, read_only, floating_point_range, integer_range }: Descriptor): string {
  const range = floating_point_range[0] ?? integer_range[0];
  const parts = [description, range && `${range.from_value} to ${range.to_value}`, read_only && "fixed while it runs"];
  return parts.filter(Boolean).join("; ");
}

/** Parses what was typed as the type of the previous value. Undefined if it cannot be parsed. */
export function readValue(text: string, before: ParameterValue | undefined): ParameterValue | undefined {
  if (typeof before === "string") return text;
  if (typeof before === "number") {
    const value = Number(text);
    return text.trim() !== "" && Number.isFinite(value) ? value : undefined;
  }
  try {
    const value = JSON.parse(text) as ParameterValue;
    return typeof value === typeof before && Array.isArray(value) === Array.isArray(before) ? value : undefined;
  } catch {
    return undefined;
  }
}
