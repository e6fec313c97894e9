# SPDX-License-Identifier: Apache-2.0
"""The ROS 2 type description hash (RIHS01): SHA-256 of a canonical JSON description of a message and all messages that it contains."""

from __future__ import annotations

import hashlib
import json

import idl

# Constants of type_description_interfaces/msg/FieldType.
_TYPE_IDS = {
    "int8": 2, "uint8": 3, "int16": 4, "uint16": 5, "int32": 6, "uint32": 7, "int64": 8, "uint64": 9,
    "float": 10, "double": 11, "boolean": 15, "octet": 16, "string": 17,
}
_NESTED_TYPE_ID = 1
_BOUNDED_STRING_ID = 21
_ARRAY_OFFSET = 48
_BOUNDED_SEQUENCE_OFFSET = 96
_SEQUENCE_OFFSET = 144


def _field_type(type_: idl.Type) -> dict:
    if type_.is_message:
        type_id = _NESTED_TYPE_ID
    elif type_.string_bound:
        type_id = _BOUNDED_STRING_ID
    else:
        type_id = _TYPE_IDS[type_.base]
    if type_.array_size:
        type_id += _ARRAY_OFFSET
    elif type_.is_sequence:
        type_id += _BOUNDED_SEQUENCE_OFFSET if type_.sequence_bound else _SEQUENCE_OFFSET
    return {
        "type_id": type_id,
        "capacity": type_.array_size or type_.sequence_bound,
        "string_capacity": type_.string_bound,
        "nested_type_name": type_.base if type_.is_message else "",
    }


def _description(message: idl.Message) -> dict:
    fields = [{"name": field.name, "type": _field_type(field.type)} for field in message.fields]
    return {"type_name": message.full_name, "fields": fields}


def type_hash(message: idl.Message, messages: dict[str, idl.Message]) -> str:
    """The hash as ROS 2 prints it: "RIHS01_" and 64 hexadecimal digits. Comments, constants and defaults do not affect it."""
    description = {
        "type_description": _description(message),
        "referenced_type_descriptions": [_description(messages[name]) for name in sorted(idl.dependencies(message, messages))],
    }
    canonical = json.dumps(description, separators=(", ", ": "))
    return "RIHS01_" + hashlib.sha256(canonical.encode()).hexdigest()
