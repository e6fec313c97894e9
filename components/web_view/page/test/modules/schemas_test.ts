// SPDX-License-Identifier: Apache-2.0
/** What viewers make of the definitions that the web view sends: in OMG IDL, messages mean the same as in ROS 2's notation. */
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import test from "node:test";
import type { MessageDefinition, MessageDefinitionField } from "@foxglove/message-definition";
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader as IdlReader } from "@foxglove/omgidl-serialization";
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";

interface Type {
  name: string;
  ros2msg: string;
  idlName: string;
  omgidl: string;
}

/** Values that differ from member to member. */
class Values {
  #next = 0;
  constructor(readonly definitions: MessageDefinition[]) {}

  message(definition: MessageDefinition): Record<string, unknown> {
    return Object.fromEntries(definition.definitions.filter((field) => field.isConstant !== true).map((field) => [field.name, this.#member(field)]));
  }

  #member(field: MessageDefinitionField): unknown {
    if (field.isArray !== true) return this.#one(field);
    return Array.from({ length: field.arrayLength ?? Math.min(3, field.arrayUpperBound ?? 3) }, () => this.#one(field));
  }

  #one(field: MessageDefinitionField): unknown {
    const value = ++this.#next % 120;
    if (field.isComplex === true) return this.message(this.definitions.find(({ name }) => name === field.type)!);
    switch (field.type) {
      case "string":
        return "x".repeat(value % 7);
      case "bool":
        return value % 2 === 1;
      case "time":
      case "duration":
        return { sec: value, nanosec: ++this.#next };
      case "int64":
      case "uint64":
        return BigInt(value) << 33n;
      case "float32":
      case "float64":
        return value / 8;
      default:
        return value;
    }
  }
}

/** With lists instead of typed arrays, and without the byte that stands in an empty message. */
function plain(value: unknown): unknown {
  if (ArrayBuffer.isView(value)) return Array.from(value as Uint8Array);
  if (Array.isArray(value)) return value.map(plain);
  if (typeof value !== "object" || value === null) return value;
  const members = Object.entries(value).filter(([name]) => name !== "structure_needs_at_least_one_member");
  return Object.fromEntries(members.map(([name, member]) => [name, plain(member)]));
}

const printer = process.env.PANVO_SCHEMAS ?? "";

test("definitions of every type in OMG IDL decode messages as those in ROS 2's notation", { skip: !fs.existsSync(printer) && "the program that prints them was not built" }, () => {
  const types = JSON.parse(execFileSync(printer, { encoding: "utf8", maxBuffer: 100_000_000 })) as Type[];
  assert.ok(types.length > 100, `${types.length} types`);
  for (const { name, ros2msg, idlName, omgidl } of types) {
    const definitions = parse(ros2msg, { ros2: true });
    const idl = new IdlReader(idlName, parseIDL(omgidl));
    const root = definitions.find((definition) => definition.name === undefined && definition.definitions.some(({ isConstant }) => isConstant !== true));
    if (root === undefined) {
      assert.deepEqual(plain(idl.readMessage(new Uint8Array([0, 1, 0, 0, 0]))), {}, name);
      continue;
    }
    const bytes = new MessageWriter(definitions).writeMessage(new Values(definitions).message(root));
    assert.deepEqual(plain(idl.readMessage(bytes)), plain(new MessageReader(definitions).readMessage(bytes)), name);
  }
});
