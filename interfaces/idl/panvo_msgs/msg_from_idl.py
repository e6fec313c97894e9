# SPDX-License-Identifier: Apache-2.0
"""Writes a message definition of this folder in ROS 2's .msg notation, with its comments; `ros2 interface show` reads only that."""
import pathlib
import re
import sys

TYPES = {"boolean": "bool", "float": "float32", "double": "float64"}
CONSTANT = re.compile(r"const (?P<type>\w+) (?P<name>\w+) = (?P<value>[^;]+);\s*(?P<comment>//.*)?$")
MEMBER = re.compile(r"(?P<sequence>sequence<)?(?P<type>[\w:]+)>? (?P<name>\w+)(?P<size>\[\d+\])?;\s*(?P<comment>//.*)?$")
IGNORED = re.compile(r"#.*|module .*|struct .*|};|// SPDX.*|$")


def type_of(text):
    return TYPES.get(text, text.replace("::msg::", "/"))


def converted(line):
    """None: nothing of the line belongs into a .msg file."""
    if IGNORED.fullmatch(line):
        return None
    if line.startswith("//"):
        return "#" + line[2:]
    if constant := CONSTANT.fullmatch(line):
        text = f"{constant['type']} {constant['name']}={constant['value']}"
    elif member := MEMBER.fullmatch(line):
        text = f"{type_of(member['type'])}{'[]' if member['sequence'] else member['size'] or ''} {member['name']}"
    else:
        raise ValueError(line)
    comment = (constant or member)["comment"]
    return f"{text}  #{comment[2:]}" if comment else text


def main():
    source, target = map(pathlib.Path, sys.argv[1:])
    try:
        lines = [converted(line.strip()) for line in source.read_text(encoding="utf-8").splitlines()]
    except ValueError as error:
        sys.exit(f"{source}: not understood: {error}")
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("".join(line + "\n" for line in lines if line is not None), encoding="utf-8")


if __name__ == "__main__":
    main()
