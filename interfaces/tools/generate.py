#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Generates the message library of a package: C++ classes, type table, and IDL for packages whose messages contain these."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

# No bytecode caches: the source tree may be read-only.
sys.dont_write_bytecode = True

import idl  # noqa: E402
import idl_text  # noqa: E402
import message_classes  # noqa: E402
import message_table  # noqa: E402
import msg_file  # noqa: E402


def _write_if_changed(path: Path, text: str) -> None:
    """Keeps the time stamp of a file with unchanged text, so that nothing is recompiled for it."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _read_file(path: Path, package: str) -> list[idl.Message]:
    if path.suffix not in (".idl", ".msg", ".srv"):
        raise idl.IdlError(f"{path}: not a supported definition; use .idl, .msg or .srv")
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
    """Packages of other libraries whose messages are contained in `messages`."""
    names = {name for message in messages.values() for name in message.direct_dependencies if name not in messages}
    return sorted({known[name].package for name in names})


def _sources(messages: dict[str, idl.Message], known: dict[str, idl.Message], rules: list[str]) -> dict[str, str]:
    files = message_classes.headers(messages, known)
    files["message_table.cpp"] = message_table.table(messages, known, rules)
    return files


def _definitions(messages: dict[str, idl.Message]) -> dict[str, str]:
    return {f"idl/{name}.idl": idl_text.text(defined) for name, defined in message_classes.by_file(messages).items()}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tree", type=Path, help="folder with the definitions of the library, <package>/{msg,srv}/<Name>.idl")
    parser.add_argument("--package", help="package of FILE...")
    parser.add_argument("files", metavar="FILE", type=Path, nargs="*", help="definitions of the library: .idl, .msg or .srv")
    parser.add_argument("--known", type=Path, action="append", default=[], help="folder with definitions of other libraries, like --tree")
    parser.add_argument("--rules", action="append", default=[], help="include path of a header that declares problem_of() of messages")
    parser.add_argument("--output", type=Path, required=True, help="output folder for <package>/{msg,srv}/<Name>.h, idl/ and message_table.cpp")
    parser.add_argument("--prepare", action="store_true", help="only write idl/; print the packages of contained messages, then the names of the files")
    arguments = parser.parse_args()
    try:
        known = idl.read_trees(arguments.known)
        messages = idl.read_trees([arguments.tree]) if arguments.tree else _read_files(arguments.files, arguments.package)
        for name in messages:
            if name in known:
                raise idl.IdlError(f"{name} is already defined by another library; use that one or choose another name")
        idl.require_definitions(messages, known)
        idl.require_cpp_names(messages)
        if arguments.prepare:
            files = _definitions(messages)
            print(";".join(_needed_packages(messages, known)))
            print(";".join(message_classes.by_file(messages)))
        else:
            files = _sources(messages, known, arguments.rules)
    except (idl.IdlError, OSError) as error:
        print(f"generate.py: {error}", file=sys.stderr)
        return 1
    for name, text in files.items():
        _write_if_changed(arguments.output / name, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
