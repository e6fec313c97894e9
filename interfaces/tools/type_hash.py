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


def _hash(description: dict) -> str:
    canonical = json.dumps(description, separators=(", ", ": "))
    return "RIHS01_" + hashlib.sha256(canonical.encode()).hexdigest()


def _hash_with_dependencies(message: idl.Message, messages: dict[str, idl.Message]) -> str:
    return _hash({
        "type_description": _description(message),
        "referenced_type_descriptions": [_description(messages[name]) for name in sorted(idl.dependencies(message, messages))],
    })


def type_hash(message: idl.Message, messages: dict[str, idl.Message]) -> str:
    """The hash as ROS 2 prints it: "RIHS01_" and 64 hexadecimal digits. Comments, constants and defaults do not affect it."""
    return _hash_with_dependencies(message, messages)


_TIME = idl.Message("builtin_interfaces", "Time", fields=[
    idl.Field("sec", idl.Type("int32")), idl.Field("nanosec", idl.Type("uint32"))])
_EVENT_INFO = idl.Message("service_msgs", "ServiceEventInfo", fields=[
    idl.Field("event_type", idl.Type("uint8")), idl.Field("stamp", idl.Type(_TIME.full_name)),
    idl.Field("client_gid", idl.Type("uint8", array_size=16)), idl.Field("sequence_number", idl.Type("int64"))])


def service_hash(package: str, name: str, messages: dict[str, idl.Message]) -> str:
    """The hash of a service, which ROS 2 treats as a message of request, response and the event of service introspection."""
    request, response = f"{package}/srv/{name}_Request", f"{package}/srv/{name}_Response"
    event = idl.Message(package, f"{name}_Event", kind="srv", fields=[
        idl.Field("info", idl.Type(_EVENT_INFO.full_name)),
        idl.Field("request", idl.Type(request, is_sequence=True, sequence_bound=1)),
        idl.Field("response", idl.Type(response, is_sequence=True, sequence_bound=1))])
    service = idl.Message(package, name, kind="srv", fields=[
        idl.Field("request_message", idl.Type(request)), idl.Field("response_message", idl.Type(response)),
        idl.Field("event_message", idl.Type(event.full_name))])
    every = {**messages, **{other.full_name: other for other in (_TIME, _EVENT_INFO, event)}}
    return _hash_with_dependencies(service, every)
