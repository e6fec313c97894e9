# SPDX-License-Identifier: Apache-2.0
"""Generates the C++ classes of messages with eProsima's fastddsgen."""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path

import idl
import idl_text
from type_hash import type_hash

# fastddsgen runs for a few seconds only. Without Java's optimising compiler it takes half the time.
_JAVA_OPTIONS = "-XX:TieredStopAtLevel=1 -XX:+UseSerialGC"


class GeneratorError(Exception):
    """fastddsgen failed. The message contains its output."""


def _flat_name(file_name: str) -> str:
    """File name that includes the package, because fastddsgen writes all its output into one folder."""
    return file_name.replace("/", "__")


def by_file(messages: dict[str, idl.Message]) -> dict[str, list[idl.Message]]:
    """Messages by the file that defines them. A service's request and response are in one file."""
    files: dict[str, list[idl.Message]] = {}
    for message in messages.values():
        files.setdefault(message.file_name, []).append(message)
    return files


def _write_flat_files(files: dict[str, list[idl.Message]], wanted: Iterable[str], folder: Path) -> Path:
    """Writes the definitions under their flat names. Returns a file that includes those wanted, so that one Java process handles all."""
    for name, defined in files.items():
        (folder / f"{_flat_name(name)}.idl").write_text(idl_text.text(defined, _flat_name), encoding="utf-8")
    root = folder / "all_messages.idl"
    root.write_text("".join(f'#include "{_flat_name(name)}.idl"\n' for name in wanted), encoding="utf-8")
    return root


def _run_fastddsgen(fastddsgen: str, root: Path, output: Path) -> str:
    """Returns its stdout. Raises GeneratorError."""
    command = [fastddsgen, "-cs", "-typeros2", "-replace", "-I", str(root.parent), "-t", str(root.parent), "-d", str(output), str(root)]
    environment = {**os.environ, "JDK_JAVA_OPTIONS": _JAVA_OPTIONS}
    result = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    # Java reports options from the environment on stderr.
    complaints = [line for line in result.stderr.splitlines() if line.strip() and "Picked up J" not in line]
    # After some crashes its exit status is 0, but it has written to stderr.
    if result.returncode != 0 or complaints:
        raise GeneratorError("\n".join([f"{' '.join(command)} failed with status {result.returncode}:", result.stdout, *complaints]))
    return result.stdout


def _header(file_name: str, messages: list[idl.Message], every: dict[str, idl.Message], text: str) -> str:
    """Adapts a generated header: includes the messages of its fields by path and adds the type hashes."""
    text = re.sub(r'#include "[^"]*"\n', "", text)
    needed = dict.fromkeys(name for message in messages for name in message.direct_dependencies)
    own_includes = "".join(f'#include "{name}.h"\n' for name in needed)
    anchor = "#include <fastrtps/utils/fixed_size_string.hpp>\n"
    if text.count(anchor) != 1:
        raise GeneratorError(f"{file_name}: unexpected header from fastddsgen; only version 2.3.0 is supported")
    body, end, rest = text.replace(anchor, own_includes + anchor).rpartition("#endif")  # of the include guard
    return body.rstrip() + "\n" + _hashes(messages, every) + "\n" + end + rest.rstrip() + "\n"


def _hashes(messages: list[idl.Message], every: dict[str, idl.Message]) -> str:
    """C++ code with the type hashes that a binary is compiled with; compared with those of the library when it is loaded."""
    lines = ["", "namespace panvo::interfaces {", "template <class Message>", "struct CompiledHash;"]
    for message in messages:
        lines += ["template <>", f"struct CompiledHash<::{message.cpp_name}> {{", f'  static constexpr char kValue[] = "{type_hash(message, every)}";', "};"]
    return "\n".join([*lines, "}  // namespace panvo::interfaces", ""])


def _source(file_name: str, _messages: list[idl.Message], _every: dict[str, idl.Message], text: str) -> str:
    """Adapts a generated source file: includes its header by path, and removes addresses of Java objects, which differ between runs."""
    text = re.sub(r"\n\s*// m_\w+ com\.eprosima\.[^\n]*", "", text)
    return text.replace(f'#include "{_flat_name(file_name)}.h"', f'#include "{file_name}.h"').rstrip() + "\n"


def generate(messages: dict[str, idl.Message], known: dict[str, idl.Message], fastddsgen: str) -> dict[str, str]:
    """Contents of <package>/msg/<Name>.h and .cxx for each message, <package>/srv/... for each service, by path. `known`: messages of other
    libraries that they may contain. Raises GeneratorError."""
    files = {}
    own = by_file(messages)
    with tempfile.TemporaryDirectory() as temporary:
        idl_folder, output = Path(temporary, "idl"), Path(temporary, "cpp")
        idl_folder.mkdir()
        output.mkdir()
        said = _run_fastddsgen(fastddsgen, _write_flat_files({**by_file(known), **own}, own, idl_folder), output)
        for name, defined in own.items():
            for suffix, adapt in ((".h", _header), (".cxx", _source)):
                path = output / (_flat_name(name) + suffix)
                if not path.exists():
                    raise GeneratorError(f"{name}: fastddsgen did not write {path.name}; its output:\n{said}")
                files[name + suffix] = adapt(name, defined, {**known, **messages}, path.read_text(encoding="utf-8"))
    return files
