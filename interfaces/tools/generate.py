#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Generates everything that is made from the IDL: the message classes and the table of message types."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

# Bytecode caches have no place in a source tree that may be read-only.
sys.dont_write_bytecode = True

import idl  # noqa: E402
import message_classes  # noqa: E402
import message_table  # noqa: E402


def _write_if_changed(path: Path, text: str) -> None:
    """Leaves the time stamp of an unchanged file alone, so that nothing is compiled again for it."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--idl", type=Path, required=True, help="folder with <package>/msg/<Name>.idl and <package>/srv/<Name>.idl")
    parser.add_argument("--output", type=Path, required=True, help="folder for <package>/{msg,srv}/<Name>.{h,cxx} and message_table.cpp")
    parser.add_argument("--fastddsgen", default="fastddsgen", help="the generator of the classes")
    arguments = parser.parse_args()
    try:
        messages = idl.read_messages(arguments.idl)
        files = message_classes.generate(messages, arguments.idl, arguments.fastddsgen)
        files["message_table.cpp"] = message_table.table(messages)
    except (idl.IdlError, message_classes.GeneratorError, OSError) as error:
        print(f"generate.py: {error}", file=sys.stderr)
        return 1
    for name, text in files.items():
        _write_if_changed(arguments.output / name, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
