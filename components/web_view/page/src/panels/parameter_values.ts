// SPDX-License-Identifier: Apache-2.0
import type { ParameterValue } from "../link/wire.ts";

/** The part of rcl_interfaces/msg/ParameterDescriptor that is shown. */
export interface Descriptor {
  description: string;
  read_only: boolean;
  floating_point_range: { from_value: number; to_value: number }[];
  integer_range: { from_value: number | bigint; to_value: number | bigint }[];
}

/** "/panvo/localizer.integrity.risk": node and parameter. */
export function nodeOf(name: string): { node: string; parameter: string } {
  const dot = name.indexOf(".", name.lastIndexOf("/") + 1);
  return dot < 0 ? { node: "", parameter: name } : { node: name.slice(0, dot), parameter: name.slice(dot + 1) };
}

export function rangeText({ description, read_only, floating_point_range, integer_range }: Descriptor): string {
  const range = floating_point_range[0] ?? integer_range[0];
  const parts = [description, range && `${range.from_value} to ${range.to_value}`, read_only && "fixed while it runs"];
  return parts.filter(Boolean).join("; ");
}

/** What was typed, as a value of the same type as the one before. Undefined: it is none. */
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
