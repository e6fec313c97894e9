# SPDX-License-Identifier: Apache-2.0
"""Generates the C++ table with the panvo::interfaces::MessageType of each message."""

from __future__ import annotations

import json

import idl
from ros2msg import definition
from type_hash import service_hash, type_hash

_SIZES = {
    "boolean": 1, "octet": 1, "int8": 1, "uint8": 1, "int16": 2, "uint16": 2, "int32": 4, "uint32": 4, "int64": 8, "uint64": 8,
    "float": 4, "double": 8,
}
_FLOATS = ("float", "double")
_TIME = "builtin_interfaces/msg/Time"
_HEADER = "std_msgs/msg/Header"


def _identifier(message: idl.Message) -> str:
    return f"{message.package}_{message.name}" if message.kind == "msg" else f"{message.package}_srv_{message.name}"


def _field(field: idl.Field, messages: dict[str, idl.Message]) -> str:
    type_ = field.type
    if type_.is_message:
        element = f".nested = &k_{_identifier(messages[type_.base])}_layout"
    elif type_.base == "string":
        element = ".is_string = true"
    else:
        element = f".size = {_SIZES[type_.base]}"
        if type_.base in _FLOATS:
            element += ", .number = CdrNumber::kFloat"
        elif type_.base == "boolean":
            element += ", .number = CdrNumber::kBool"
        elif type_.base.startswith("int"):
            element += ", .number = CdrNumber::kSigned"
    count = f", .array_size = {type_.array_size}, .is_array = true" if type_.array_size else ""
    sequence = ", .is_sequence = true" if type_.is_sequence else ""
    return f'    {{.name = "{field.name}", {element}{count}{sequence}}},'


def _layout(message: idl.Message, messages: dict[str, idl.Message]) -> str:
    name = f"k_{_identifier(message)}"
    fields = "\n".join(_field(field, messages) for field in message.fields)
    return f"constexpr CdrField {name}_fields[] = {{\n{fields}\n}};\nconstinit const CdrLayout {name}_layout{{{name}_fields}};\n"


def _time_member(message: idl.Message) -> str | None:
    """C++ accessors from a message to its stamp; None if it has no stamp."""
    for field in message.fields:
        if field.type == idl.Type(_HEADER) and field.name == "header":
            return "header().stamp()"
        if field.type == idl.Type(_TIME) and field.name in ("stamp", "clock"):
            return f"{field.name}()"
    return None


def stamp_expression(message: idl.Message, messages: dict[str, idl.Message]) -> str:
    """C++ expression for the stamp of `message`: that of its header, its own, or that of the first element if it is only a sequence."""
    member = _time_member(message)
    if member:
        return f"to_ns(message.{member})"
    only = message.fields[0]
    if len(message.fields) == 1 and only.type.is_sequence and only.type.is_message:
        member = _time_member(messages[only.type.base])
        if member:
            return f"message.{only.name}().empty() ? std::nullopt : to_ns(message.{only.name}().front().{member})"
    return "std::nullopt"


def _facts(message: idl.Message, messages: dict[str, idl.Message]) -> str:
    cpp = f"::{message.cpp_name}"
    # A JSON string of ASCII text is also a C++ string literal.
    text = "\n".join(f"      {json.dumps(line)}" for line in definition(message, messages).splitlines(keepends=True))
    stamp = stamp_expression(message, messages)
    argument = "" if stamp == "std::nullopt" else " message"
    return f"""template <>
struct Facts<{cpp}> {{
  static constexpr std::string_view name = "{message.full_name}";
  static constexpr std::string_view dds_name = "{message.package}::{message.kind}::dds_::{message.name}_";
  static constexpr std::string_view hash = "{type_hash(message, messages)}";
  static constexpr std::string_view definition =
{text};
  static constexpr const CdrLayout& layout = k_{_identifier(message)}_layout;
  static std::optional<std::int64_t> stamp_ns(const {cpp}&{argument}) {{ return {stamp}; }}
}};
"""


def _services(messages: dict[str, idl.Message], every: dict[str, idl.Message]) -> str:
    """Table of the services, whose requests and responses are messages."""
    services = [(m.package, m.name.removesuffix("_Request")) for m in messages.values() if m.kind == "srv" and m.name.endswith("_Request")]
    if not services:
        return ""
    entries = "".join(f'    {{"{package}/srv/{name}", "{service_hash(package, name, every)}"}},\n' for package, name in services)
    return f"constexpr ServiceType kServiceTypes[] = {{\n{entries}}};\nconst ServiceTable kServices{{kServiceTypes}};\n"


def table(messages: dict[str, idl.Message], known: dict[str, idl.Message], rules: list[str]) -> str:
    """Source file for the library of `messages`. `known`: messages of other libraries that they may contain. `rules`: headers that declare
    problem_of()."""
    every = {**known, **messages}
    includes = "".join(f'#include "{name}.h"\n' for name in dict.fromkeys(m.file_name for m in messages.values()))
    declared_rules = "".join(f'#include "{header}"\n' for header in rules)
    contained = dict.fromkeys(name for message in messages.values() for name in message.direct_dependencies)
    declared = [*messages.values(), *(every[name] for name in contained if name not in messages)]
    declarations = "".join(f"extern const CdrLayout k_{_identifier(message)}_layout;\n" for message in declared)
    layouts = "\n".join(_layout(message, every) for message in messages.values())
    facts = "\n".join(_facts(message, every) for message in messages.values())
    instances = "".join(f"template const MessageType& message_type<::{m.cpp_name}>();\n" for m in messages.values())
    entries = "".join(f"    &kMessageType<::{m.cpp_name}>,\n" for m in messages.values())
    return f"""// Generated from the IDL of the messages below.
{declared_rules}#include "panvo/interfaces/message_codec.hpp"
#include "panvo/interfaces/service_type.hpp"

{includes}
namespace panvo::interfaces {{

// Layouts are shared by all libraries: a message of one may contain a message of another.
{declarations}
{layouts}
{facts}
{instances}
namespace {{

constexpr const MessageType* kMessageTypes[] = {{
{entries}}};
const MessageTable kTable{{kMessageTypes}};
{_services(messages, every)}
}}  // namespace
}}  // namespace panvo::interfaces
"""
