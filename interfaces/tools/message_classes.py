# SPDX-License-Identifier: Apache-2.0
"""Writes the C++ classes of messages: members with accessors as in eProsima's IDL-to-C++ mapping, defaults, comparison, and the visit of all
members by which they are encoded and decoded."""

from __future__ import annotations

import json
import re

import idl
from type_hash import type_hash

_NUMBERS = {
    "boolean": "bool", "octet": "std::uint8_t", "float": "float", "double": "double",
    **{f"{sign}int{bits}": f"std::{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)},
}


def by_file(messages: dict[str, idl.Message]) -> dict[str, list[idl.Message]]:
    """Messages by the file that defines them. A service's request and response are in one file."""
    files: dict[str, list[idl.Message]] = {}
    for message in messages.values():
        files.setdefault(message.file_name, []).append(message)
    return files


def _element(base: str) -> str:
    if base == "string":
        return "std::string"
    return _NUMBERS.get(base) or "::" + base.replace("/", "::")


def _type(type_: idl.Type) -> str:
    element = _element(type_.base)
    if type_.array_size:
        return f"std::array<{element}, {type_.array_size}>"
    return f"std::vector<{element}>" if type_.is_sequence else element


def _unquoted(text: str) -> str:
    if len(text) > 1 and text[0] == text[-1] and text[0] in "\"'":
        text = text[1:-1]
    return re.sub(r"\\(.)", r"\1", text)


def _value(base: str, text: str) -> str:
    """C++ literal of a constant or default."""
    if base == "string":
        return json.dumps(_unquoted(text))
    if base == "boolean":
        return "true" if text.lower() in ("true", "1") else "false"
    return text + "U" if base == "uint64" else text


def _constants(message: idl.Message) -> list[str]:
    if not message.constants:
        return []
    lines = [f"namespace {message.name}_Constants {{"]
    for constant in message.constants:
        type_ = "const char*" if constant.type == "string" else _NUMBERS[constant.type]
        lines.append(f"inline constexpr {type_} {constant.name} = {_value(constant.type, constant.value)};")
    return [*lines, f"}}  // namespace {message.name}_Constants", ""]


def _accessors(field: idl.Field) -> list[str]:
    type_, name = _type(field.type), field.name
    is_number = type_ in _NUMBERS.values()
    return [
        f"  {type_ if is_number else f'const {type_}&'} {name}() const {{ return {name}_; }}",
        f"  {type_}& {name}() {{ return {name}_; }}",
        f"  void {name}({type_} value) {{ {name}_ = {'value' if is_number or field.type.array_size else 'std::move(value)'}; }}",
    ]


def _member(field: idl.Field) -> str:
    is_single = not field.type.array_size and not field.type.is_sequence
    default = _value(field.type.base, field.default) if field.default and is_single else ""
    return f"  {_type(field.type)} {field.name}_{{{default}}};"


def _class(message: idl.Message) -> list[str]:
    lines = _constants(message)
    lines += [f"/// {line}".rstrip() for line in message.comment.splitlines()]
    lines += [f"class {message.name} {{", " public:"]
    for field in message.fields:
        lines += _accessors(field)
    lines += ["", f"  bool operator==(const {message.name}&) const = default;", "", "  /// Calls `visit` with each member, in the order of the definition."]
    lines += ["  static void for_each_member(auto& message, auto&& visit) {"]
    lines += [f"    visit(message.{field.name}_);" for field in message.fields]
    lines += ["  }", "", " private:", *map(_member, message.fields), "};", ""]
    return lines


def _hashes(messages: list[idl.Message], every: dict[str, idl.Message]) -> list[str]:
    """The type hashes that a binary is compiled with; compared with those of the library when it is loaded."""
    lines = ["namespace panvo::interfaces {", "template <class Message>", "struct CompiledHash;"]
    for message in messages:
        lines += ["template <>", f"struct CompiledHash<::{message.cpp_name}> {{", f'  static constexpr char kValue[] = "{type_hash(message, every)}";', "};"]
    return [*lines, "}  // namespace panvo::interfaces"]


def header(messages: list[idl.Message], every: dict[str, idl.Message]) -> str:
    """Header of a message, or of a service's request and response."""
    first = messages[0]
    needed = dict.fromkeys(name for message in messages for name in message.direct_dependencies)
    lines = [f"// Generated from {first.file_name}.", "#pragma once", "", "#include <array>", "#include <cstdint>", "#include <string>",
             "#include <utility>", "#include <vector>", "", *(f'#include "{name}.h"' for name in needed), ""]
    lines += [f"namespace {first.package}::{first.kind} {{", ""]
    for message in messages:
        lines += _class(message)
    lines += [f"}}  // namespace {first.package}::{first.kind}", "", *_hashes(messages, every)]
    return "\n".join(lines) + "\n"


def headers(messages: dict[str, idl.Message], known: dict[str, idl.Message]) -> dict[str, str]:
    """Contents of <package>/msg/<Name>.h for each message, <package>/srv/<Name>.h for each service, by path. `known`: messages of other
    libraries that they may contain."""
    every = {**known, **messages}
    return {f"{name}.h": header(defined, every) for name, defined in by_file(messages).items()}
