// SPDX-License-Identifier: Apache-2.0
/** Encodes and decodes CDR messages, using the definition that the server sends with each channel. */
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";

/** Whether a definition has no members. */
export const isEmpty = (schema: string): boolean => schema.replace(/#.*/g, "").trim() === "";

/** A request without members: CDR has one byte in their place. */
const nothing = new Uint8Array([0, 1, 0, 0, 0]);

const readers = new Map<string, MessageReader>();
const writers = new Map<string, MessageWriter>();

function kept<Value>(map: Map<string, Value>, key: string, make: () => Value): Value {
  let value = map.get(key);
  if (value === undefined) map.set(key, (value = make()));
  return value;
}

/** Throws if the definition is empty or malformed. */
export function readerOf(schema: string): MessageReader {
  if (schema.trim() === "") throw new Error("the server sent no definition of this type");
  return kept(readers, schema, () => new MessageReader(parse(schema, { ros2: true })));
}

export function encoded(schema: string, message: unknown): Uint8Array {
  if (isEmpty(schema)) return nothing;
  return kept(writers, schema, () => new MessageWriter(parse(schema, { ros2: true }))).writeMessage(message);
}
