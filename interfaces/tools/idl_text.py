# SPDX-License-Identifier: Apache-2.0
"""Writes messages as IDL, for packages whose messages contain them."""

from __future__ import annotations

import idl

# IDL 4.2 keywords that ROS 2 allows as field names. A leading '_' escapes them and is not part of the name.
_KEYWORDS = frozenset("""
    abstract any alias attribute bitfield bitmask bitset boolean case char component connector const consumes context custom default double emits enum
    eventtype exception factory finder fixed float getraises getter home import in inout interface local long manages map mirrorport module multiple
    native object octet oneway out port porttype primarykey private provides public publishes raises readonly sequence setraises short string struct
    supports switch truncatable typedef typeid typename typeprefix union unsigned uses valuebase valuetype void wchar wstring
    """.split())


def _name(name: str) -> str:
    return f"_{name}" if name in _KEYWORDS else name


def _type(type_: idl.Type) -> str:
    base = type_.base.replace("/", "::")
    if type_.string_bound:
        base += f"<{type_.string_bound}>"
    if type_.is_sequence:
        base = f"sequence<{base}, {type_.sequence_bound}>" if type_.sequence_bound else f"sequence<{base}>"
    return base


def _default(field: idl.Field) -> str:
    """Only for single values: IDL has no notation for defaults of arrays."""
    if not field.default or field.type.array_size or field.type.is_sequence:
        return ""
    value = field.default
    if field.type.base == "string":
        value = '"' + value.strip("\"'").replace('"', '\\"') + '"'
    elif field.type.base == "boolean":
        value = "TRUE" if value.lower() in ("true", "1") else "FALSE"
    return f"@default(value={value}) "


def _struct(message: idl.Message) -> list[str]:
    lines = []
    if message.constants:
        lines.append(f"    module {message.name}_Constants {{")
        lines += [f"      const {constant.type} {constant.name} = {constant.value};" for constant in message.constants]
        lines.append("    };")
    lines += [f"    // {line}".rstrip() for line in message.comment.splitlines()]
    lines.append(f"    struct {message.name} {{")
    for field in message.fields:
        size = f"[{field.type.array_size}]" if field.type.array_size else ""
        comment = f"  // {field.comment}" if field.comment else ""
        lines.append(f"      {_default(field)}{_type(field.type)} {_name(field.name)}{size};{comment}")
    lines.append("    };")
    return lines


def text(messages: list[idl.Message]) -> str:
    """IDL file of a message, or of a service's request and response."""
    first = messages[0]
    guard = first.file_name.replace("/", "__") + "_idl"
    needed = dict.fromkeys(name for message in messages for name in message.direct_dependencies)
    lines = [f"#ifndef {guard}", f"#define {guard}", ""]
    lines += [f'#include "{name}.idl"' for name in needed] + ([""] if needed else [])
    lines += [f"module {first.package} {{", f"  module {first.kind} {{"]
    for message in messages:
        lines += _struct(message)
    lines += ["  };", "};", "", f"#endif  // {guard}"]
    return "\n".join(lines) + "\n"
