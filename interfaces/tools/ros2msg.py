# SPDX-License-Identifier: Apache-2.0
"""Message definitions in ROS 2's .msg notation. Bags store them so that tools can read messages of unknown type."""

from __future__ import annotations

import idl

_NAMES = {"boolean": "bool", "octet": "byte", "float": "float32", "double": "float64"}
_SEPARATOR = "=" * 80


def _type(type_: idl.Type, package: str) -> str:
    base = _NAMES.get(type_.base, type_.base)
    if type_.is_message:
        other_package, _, name = type_.base.split("/")
        base = name if other_package == package else f"{other_package}/{name}"
    if type_.string_bound:
        base += f"<={type_.string_bound}"
    if type_.array_size:
        base += f"[{type_.array_size}]"
    elif type_.is_sequence:
        base += f"[<={type_.sequence_bound}]" if type_.sequence_bound else "[]"
    return base


def _value(constant: idl.Constant) -> str:
    return constant.value.lower() if constant.type == "boolean" else constant.value


def _constants_of(field: idl.Field, message: idl.Message) -> list[idl.Constant]:
    """Constants that the field's comment refers to. Viewers show their names for the values of the field that follows them."""
    if not field.comment.startswith("one of the constants"):
        return []
    return [constant for constant in message.constants if constant.type == field.type.base]


def _own_definition(message: idl.Message) -> str:
    lines = [f"# {line}" for line in message.comment.splitlines()]

    def add(constants: list[idl.Constant]) -> None:
        lines.extend(f"{_NAMES.get(constant.type, constant.type)} {constant.name}={_value(constant)}" for constant in constants)

    of_fields = [_constants_of(field, message) for field in message.fields]
    add([constant for constant in message.constants if not any(constant in constants for constants in of_fields)])
    for field, constants in zip(message.fields, of_fields):
        if field.name == idl.PLACEHOLDER:
            continue
        add(constants)
        comment = f"  # {field.comment}" if field.comment else ""
        default = f" {field.default}" if field.default else ""
        lines.append(f"{_type(field.type, message.package)} {field.name}{default}{comment}")
    return "\n".join(lines) + "\n"


def definition(message: idl.Message, messages: dict[str, idl.Message]) -> str:
    """Definition of a message and of each message that it contains, separated as in rosbag2."""
    parts = [_own_definition(message)]
    for name in idl.dependencies(message, messages):
        other = messages[name]
        parts.append(f"MSG: {other.package}/{other.name}\n{_own_definition(other)}")
    return f"\n{_SEPARATOR}\n".join(parts)
