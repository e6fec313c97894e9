// SPDX-License-Identifier: Apache-2.0
/** Messages to and from CDR, by the definition that the server sends with each channel. */
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";

const readers = new Map<string, MessageReader>();
const writers = new Map<string, MessageWriter>();

function kept<Value>(map: Map<string, Value>, key: string, make: () => Value): Value {
  let value = map.get(key);
  if (value === undefined) map.set(key, (value = make()));
  return value;
}

/** Throws if the definition is empty or malformed. */
export function readerOf(schema: string): MessageReader {
  if (schema === "") throw new Error("the server has no definition of the type");
  return kept(readers, schema, () => new MessageReader(parse(schema, { ros2: true })));
}

export function writerOf(schema: string): MessageWriter {
  return kept(writers, schema, () => new MessageWriter(parse(schema, { ros2: true })));
}
