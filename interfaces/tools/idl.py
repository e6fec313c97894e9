# SPDX-License-Identifier: Apache-2.0
"""Reads definitions in the subset of OMG IDL that ROS 2 uses. The file of a message has one struct, in modules <package>::msg; that of a
service has two, <Name>_Request and <Name>_Response, in modules <package>::srv."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

PRIMITIVES = ("boolean", "octet", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float", "double")

PLACEHOLDER = "structure_needs_at_least_one_member"  # ROS 2 adds it to empty messages

_TOKEN = re.compile(
    r"\s+|(?P<comment>//[^\n]*)|(?P<directive>\#[^\n]*)"
    r"|(?P<word>[A-Za-z_]\w*(?:::\w+)*|-?[\d.]+(?:[eE][-+]?\d+)?|\"(?:[^\"\\\n]|\\.)*\")|(?P<sign>[{}()<>\[\];,=@])")


class IdlError(Exception):
    """An unusable definition. The message gives file, line and remedy."""


@dataclass(frozen=True)
class Type:
    """Type of a field: a primitive, "string" or a message ("std_msgs/msg/Header"); or an array or sequence of it."""

    base: str
    string_bound: int = 0  # maximum length of a string in bytes; 0: no limit
    array_size: int = 0  # elements of a fixed-size array; 0: not an array
    is_sequence: bool = False
    sequence_bound: int = 0  # maximum number of elements of a sequence; 0: no limit

    @property
    def is_message(self) -> bool:
        return "/" in self.base


@dataclass(frozen=True)
class Field:
    name: str
    type: Type
    default: str = ""
    comment: str = ""


@dataclass(frozen=True)
class Constant:
    name: str
    type: str
    value: str


@dataclass
class Message:
    package: str
    name: str
    comment: str = ""
    fields: list[Field] = field(default_factory=list)
    constants: list[Constant] = field(default_factory=list)
    kind: str = "msg"  # "srv" for the request or response of a service

    @property
    def full_name(self) -> str:
        return f"{self.package}/{self.kind}/{self.name}"

    @property
    def file_name(self) -> str:
        """Path of the files with its definition and class, without suffix. Request and response of a service share it."""
        name = self.name if self.kind == "msg" else self.name.rsplit("_", 1)[0]
        return f"{self.package}/{self.kind}/{name}"

    @property
    def cpp_name(self) -> str:
        return f"{self.package}::{self.kind}::{self.name}"

    @property
    def direct_dependencies(self) -> list[str]:
        """Names of the messages among its field types, each once, in order of first use."""
        return list(dict.fromkeys(f.type.base for f in self.fields if f.type.is_message))


def dependencies(message: Message, messages: dict[str, Message]) -> list[str]:
    """Names of all messages that it contains at any depth, each once, in order of first use."""
    found: dict[str, None] = {}

    def visit(current: Message) -> None:
        for name in current.direct_dependencies:
            if name not in found:
                found[name] = None
                visit(messages[name])

    visit(message)
    return list(found)


class _Parser:
    def __init__(self, path: Path, text: str):
        self.path = path
        self.tokens: list[tuple[str, str, int]] = []  # kind, text, line
        line, end = 1, 0
        for match in _TOKEN.finditer(text):
            if match.start() != end:
                break
            if match.lastgroup and match.lastgroup != "directive":
                self.tokens.append((match.lastgroup, match.group(), line))
            line += match.group().count("\n")
            end = match.end()
        if end != len(text):
            raise IdlError(f"{path}:{line}: cannot read {text[end:end + 20]!r}; README.md describes the supported IDL")
        self.at = 0

    def error(self, message: str) -> IdlError:
        line = self.tokens[min(self.at, len(self.tokens) - 1)][2] if self.tokens else 1
        return IdlError(f"{self.path}:{line}: {message}")

    def skip_comments(self) -> str:
        """Skips comments. Returns their text, one line per comment."""
        lines = []
        while self.at < len(self.tokens) and self.tokens[self.at][0] == "comment":
            lines.append(self.tokens[self.at][1].removeprefix("//").strip())
            self.at += 1
        return "\n".join(lines)

    def peek(self) -> str:
        self.skip_comments()
        return self.tokens[self.at][1] if self.at < len(self.tokens) else ""

    def take(self, expected: str = "") -> str:
        found = self.peek()
        if not found or (expected and found != expected):
            raise self.error(f"expected {expected or 'more'}, found {found or 'end of file'}")
        self.at += 1
        return found

    def trailing_comment(self) -> str:
        """Takes the comment, if any, on the line of the last token."""
        kind, text, line = self.tokens[self.at] if self.at < len(self.tokens) else ("", "", 0)
        if kind != "comment" or line != self.tokens[self.at - 1][2]:
            return ""
        self.at += 1
        return text.removeprefix("//").strip()

    def messages(self) -> list[Message]:
        """Returns the message of the file, or the request and response of a service."""
        self.skip_comments()
        self.take("module")
        package = self.take()
        self.take("{")
        self.take("module")
        kind = self.take()
        if kind not in ("msg", "srv"):
            raise self.error(f"module {kind} is not supported; use msg for messages, srv for services")
        self.take("{")
        messages = [self.struct(package, kind) for _ in range(1 if kind == "msg" else 2)]
        for closing in ("}", ";") * 2:
            self.take(closing)
        if self.peek():
            raise self.error(f"{self.peek()} after the definition; only one message or service per file is supported")
        return messages

    def struct(self, package: str, kind: str) -> Message:
        message = Message(package=package, name="", kind=kind)
        if self.peek() == "module":
            message.constants = self.constants()
        message.comment = self.skip_comments_before("struct")
        self.take("struct")
        message.name = self.take()
        self.take("{")
        while self.peek() != "}":
            message.fields.append(self.field(message.fields))
        for closing in ("}", ";"):
            self.take(closing)
        if not message.fields:
            raise self.error("a struct needs a member; ROS 2 uses uint8 structure_needs_at_least_one_member")
        return message

    def skip_comments_before(self, keyword: str) -> str:
        start = self.at
        while start > 0 and self.tokens[start - 1][0] == "comment":
            start -= 1
        self.at = start
        comment = self.skip_comments()
        if self.peek() != keyword:
            raise self.error(f"expected {keyword}, found {self.peek()}")
        return comment

    def constants(self) -> list[Constant]:
        self.take("module")
        self.take()
        self.take("{")
        constants = []
        while self.peek() != "}":
            self.take("const")
            base, name = self.take(), self.take()
            self.take("=")
            constants.append(Constant(name, base, self.take()))
            self.take(";")
        self.take("}")
        self.take(";")
        return constants

    def field(self, previous: list[Field]) -> Field:
        default = self.default() if self.peek() == "@" else ""
        base = self.type()
        name = self.take().removeprefix("_")  # escapes names that are IDL keywords
        if any(name == other.name for other in previous):
            raise self.error(f"duplicate field {name}")
        if self.peek() == "[":
            self.take("[")
            if base.is_sequence:
                raise self.error(f"{name}: an array of sequences is not supported; wrap the sequence in a message of its own")
            base = Type(base.base, base.string_bound, array_size=self.number())
            self.take("]")
        self.take(";")
        return Field(name, base, default, self.trailing_comment())

    def default(self) -> str:
        for expected in ("@", "default", "(", "value", "="):
            self.take(expected)
        value = self.take()
        self.take(")")
        return value

    def number(self) -> int:
        text = self.take()
        if not text.isdigit() or int(text) == 0:
            raise self.error(f"{text} is not a size; the generator needs a positive integer literal")
        return int(text)

    def type(self) -> Type:
        base = self.take()
        if base == "sequence":
            self.take("<")
            element = self.type()
            if element.is_sequence:
                raise self.error("a sequence of sequences is not supported; wrap the inner one in a message of its own")
            bound = 0
            if self.peek() == ",":
                self.take(",")
                bound = self.number()
            self.take(">")
            return Type(element.base, element.string_bound, is_sequence=True, sequence_bound=bound)
        if base == "string":
            bound = 0
            if self.peek() == "<":
                self.take("<")
                bound = self.number()
                self.take(">")
            return Type("string", bound)
        if base in PRIMITIVES:
            return Type(base)
        if re.fullmatch(r"\w+::msg::\w+", base):
            return Type(base.replace("::", "/"))
        raise self.error(f"{base} is not a supported type; use {', '.join(PRIMITIVES)}, string, sequence<...> or package::msg::Name")


def parse_file(path: Path, text: str, package: str = "") -> list[Message]:
    """Returns the definitions of a file. They must agree with its path, msg/<Name>.idl or srv/<Name>.idl, and with `package` or, if not
    given, the folder above. Raises IdlError."""
    messages = _Parser(path, text).messages()
    for message, part in zip(messages, ("_Request", "_Response")):
        if message.kind == "srv" and not message.name.endswith(part):
            raise IdlError(f"{path}: {message.name} must end in {part}; a service consists of a request and a response, in this order")
        found = (package or path.parts[-3], path.parts[-2], path.name)
        if found != (message.package, message.kind, f"{message.file_name.split('/')[-1]}.idl"):
            raise IdlError(f"{path}: defines {message.full_name}, so it must be {message.file_name}.idl{f' (in package {package})' if package else ''}")
    return messages


def parse(path: Path, text: str) -> Message:
    """Returns the message that a file defines. Raises IdlError."""
    return parse_file(path, text)[0]


def read_trees(roots: list[Path]) -> dict[str, Message]:
    """Messages, requests and responses in <root>/<package>/{msg,srv}, sorted by full name. If several roots define one, the first counts."""
    messages: dict[str, Message] = {}
    for root in roots:
        for path in sorted(root.glob("*/*/*.idl")):
            for message in parse_file(path, path.read_text(encoding="utf-8")):
                messages.setdefault(message.full_name, message)
    return dict(sorted(messages.items()))


# C++ keywords, which cannot name a field of a C++ class.
_CPP_KEYWORDS = frozenset("""
    alignas alignof and asm auto bool break case catch char class compl concept const consteval constexpr constinit continue decltype default delete do
    double else enum explicit export extern false float for friend goto if inline int long mutable namespace new noexcept not nullptr operator or
    private protected public register requires return short signed sizeof static struct switch template this throw true try typedef typeid typename
    union unsigned using virtual void volatile while xor
    """.split())


def require_cpp_names(messages: dict[str, Message]) -> None:
    """Raises IdlError if the name of a field is a C++ keyword."""
    for message in messages.values():
        for name in (field.name for field in message.fields):
            if name in _CPP_KEYWORDS:
                raise IdlError(f"{message.full_name}: {name} is a C++ keyword; rename the field")


def require_definitions(messages: dict[str, Message], known: dict[str, Message]) -> None:
    """Raises IdlError if a contained message is neither in `messages` nor in `known`."""
    for message in messages.values():
        for name in message.direct_dependencies:
            if name not in messages and name not in known:
                raise IdlError(f"{message.full_name} contains {name}, which is not defined; correct the name, or call find_package({name.split('/')[0]}) first")
