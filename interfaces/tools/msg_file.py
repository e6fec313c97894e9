# SPDX-License-Identifier: Apache-2.0
"""Reads ROS 2's .msg and .srv files into the same model as IDL files."""

from __future__ import annotations

import re
from pathlib import Path

from idl import PLACEHOLDER, Constant, Field, IdlError, Message, Type

# ROS 2's names of primitives and their IDL names, which type hash and C++ class use. In ROS 2, `char` is an unsigned byte.
_PRIMITIVES = {
    "bool": "boolean", "byte": "octet", "char": "uint8", "float32": "float", "float64": "double", "int8": "int8", "uint8": "uint8",
    "int16": "int16", "uint16": "uint16", "int32": "int32", "uint32": "uint32", "int64": "int64", "uint64": "uint64",
}
_TYPE = re.compile(r"(?P<base>[A-Za-z]\w*(?:/[A-Za-z]\w*){0,2})(?:<=(?P<string_bound>\d+))?(?P<many>\[(?:<=(?P<bound>\d+)|(?P<size>\d+))?\])?$")
_CONSTANT = re.compile(r"(?P<type>\S+)\s+(?P<name>[A-Za-z]\w*)\s*=\s*(?P<value>.*)$")
_FIELD = re.compile(r"(?P<type>\S+)\s+(?P<name>[A-Za-z]\w*)(?:\s+(?P<default>.+))?$")


def _base(name: str, package: str) -> str | None:
    """IDL name of a type without array and bound; None if it is not supported."""
    if name == "string":
        return name
    if name in _PRIMITIVES:
        return _PRIMITIVES[name]
    parts = name.split("/")
    if len(parts) == 3 and parts[1] == "msg":
        return name
    if len(parts) == 2:
        return f"{parts[0]}/msg/{parts[1]}"
    return f"{package}/msg/{name}" if len(parts) == 1 and name[0].isupper() else None


class _Part:
    """One message: a whole .msg file, or one side of a .srv file."""

    def __init__(self, path: Path, message: Message):
        self.path = path
        self.message = message
        self.waiting: list[str] = []  # comment lines for the next field

    def error(self, line: int, text: str) -> IdlError:
        return IdlError(f"{self.path}:{line}: {text}")

    def type(self, text: str, line: int) -> Type:
        match = _TYPE.match(text)
        base = _base(match["base"], self.message.package) if match else None
        if base is None or (match["string_bound"] and base != "string"):
            raise self.error(line, f"{text} is not a supported type; use {', '.join(_PRIMITIVES)}, string, package/Name, with [], [N] or [<=N]")
        return Type(base, int(match["string_bound"] or 0), int(match["size"] or 0), bool(match["many"] and not match["size"]), int(match["bound"] or 0))

    def read(self, text: str, line: int) -> None:
        """Reads one line, given without its line end."""
        content, _, comment = text.partition("#")
        content, comment = content.strip(), comment.strip()
        if not content:
            if "#" in text:
                self.waiting.append(comment)
            elif not self.message.fields and not self.message.constants and not self.message.comment:
                self.message.comment, self.waiting = "\n".join(self.waiting), []
            return
        constant = _CONSTANT.match(content)
        if constant:
            self._constant(constant, text, line)
        else:
            self._field(content, comment, line)
        self.waiting = []

    def _constant(self, match: re.Match, text: str, line: int) -> None:
        base = self.type(match["type"], line)
        if base.is_message or base.array_size or base.is_sequence:
            raise self.error(line, f"constant {match['name']} must be a number, a bool or a string")
        value = match["value"].strip()
        if base.base == "string":  # '#' is part of the string
            value = '"' + text.split("=", 1)[1].strip().strip("\"'").replace("\\", "\\\\").replace('"', '\\"') + '"'
        elif base.base == "boolean":
            value = "TRUE" if value.lower() in ("true", "1") else "FALSE"
        self.message.constants.append(Constant(match["name"], base.base, value))

    def _field(self, content: str, comment: str, line: int) -> None:
        match = _FIELD.match(content)
        if not match:
            raise self.error(line, f"cannot read '{content}'; a line must be 'type name', 'type name default' or 'type NAME=value'")
        name = match["name"]
        if any(name == other.name for other in self.message.fields):
            raise self.error(line, f"duplicate field {name}")
        type_ = self.type(match["type"], line)
        if type_.is_message and match["default"]:
            raise self.error(line, f"{name} is a message, which cannot have a default")
        comments = [*self.waiting, comment] if comment else self.waiting
        self.message.fields.append(Field(name, type_, match["default"] or "", " ".join(c for c in comments if c)))

    def done(self) -> Message:
        if not self.message.fields:
            self.message.fields.append(Field(PLACEHOLDER, Type("uint8")))
        return self.message


def parse(path: Path, text: str, package: str) -> list[Message]:
    """Returns the message of a .msg file, or the request and response of a .srv file. Raises IdlError."""
    if path.suffix == ".msg":
        parts = [_Part(path, Message(package, path.stem))]
    else:
        parts = [_Part(path, Message(package, f"{path.stem}_{part}", kind="srv")) for part in ("Request", "Response")]
    at = 0
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip() == "---":
            at += 1
            if at >= len(parts):
                raise parts[-1].error(number, "--- is allowed once, in a .srv file, between request and response")
            continue
        parts[at].read(line, number)
    if at + 1 != len(parts):
        raise parts[-1].error(1, "a service needs --- between its request and its response")
    return [part.done() for part in parts]
