#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Generates the library of a package's messages: their C++ classes, the table of their types, and their IDL for packages that contain them."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

# Bytecode caches have no place in a source tree that may be read-only.
sys.dont_write_bytecode = True

import idl  # noqa: E402
import idl_text  # noqa: E402
import message_classes  # noqa: E402
import message_table  # noqa: E402
import msg_file  # noqa: E402


def _write_if_changed(path: Path, text: str) -> None:
    """Leaves the time stamp of an unchanged file alone, so that nothing is compiled again for it."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _read_file(path: Path, package: str) -> list[idl.Message]:
    if path.suffix not in (".idl", ".msg", ".srv"):
        raise idl.IdlError(f"{path}: is not a definition that is understood: .idl, .msg or .srv")
    text = path.read_text(encoding="utf-8")
    return idl.parse_file(path, text, package) if path.suffix == ".idl" else msg_file.parse(path, text, package)


def _read_files(paths: list[Path], package: str) -> dict[str, idl.Message]:
    messages: dict[str, idl.Message] = {}
    for path in paths:
        for message in _read_file(path, package):
            if message.full_name in messages:
                raise idl.IdlError(f"{path}: {message.full_name} is defined twice")
            messages[message.full_name] = message
    return dict(sorted(messages.items()))


def _needed_packages(messages: dict[str, idl.Message], known: dict[str, idl.Message]) -> list[str]:
    """Of the messages that these contain and other libraries define."""
    names = {name for message in messages.values() for name in message.direct_dependencies if name not in messages}
    return sorted({known[name].package for name in names})


def _sources(messages: dict[str, idl.Message], known: dict[str, idl.Message], rules: list[str], fastddsgen: str) -> dict[str, str]:
    files = message_classes.generate(messages, known, fastddsgen)
    files["message_table.cpp"] = message_table.table(messages, known, rules)
    return files


def _definitions(messages: dict[str, idl.Message]) -> dict[str, str]:
    return {f"idl/{name}.idl": idl_text.text(defined) for name, defined in message_classes.by_file(messages).items()}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tree", type=Path, help="folder of definitions, <package>/{msg,srv}/<Name>.idl, of which the library is made")
    parser.add_argument("--package", help="the package of FILE...")
    parser.add_argument("files", metavar="FILE", type=Path, nargs="*", help="definitions of which the library is made: .idl, .msg or .srv")
    parser.add_argument("--known", type=Path, action="append", default=[], help="folder of definitions that other libraries hold, as of --tree")
    parser.add_argument("--rules", action="append", default=[], help="header, as it is included, that declares problem_of() for some of the messages")
    parser.add_argument("--output", type=Path, required=True, help="folder for <package>/{msg,srv}/<Name>.{h,cxx}, idl/ and message_table.cpp")
    parser.add_argument("--prepare", action="store_true", help="write idl/ only, and print the packages whose messages these contain, then the files' names")
    parser.add_argument("--fastddsgen", default="fastddsgen", help="the generator of the classes")
    arguments = parser.parse_args()
    try:
        known = idl.read_trees(arguments.known)
        messages = idl.read_trees([arguments.tree]) if arguments.tree else _read_files(arguments.files, arguments.package)
        for name in messages:
            if name in known:
                raise idl.IdlError(f"{name} is defined by another package already: use that one, or choose another name")
        idl.require_definitions(messages, known)
        idl.require_cpp_names(messages)
        if arguments.prepare:
            files = _definitions(messages)
            print(";".join(_needed_packages(messages, known)))
            print(";".join(message_classes.by_file(messages)))
        else:
            files = _sources(messages, known, arguments.rules, arguments.fastddsgen)
    except (idl.IdlError, message_classes.GeneratorError, OSError) as error:
        print(f"generate.py: {error}", file=sys.stderr)
        return 1
    for name, text in files.items():
        _write_if_changed(arguments.output / name, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
