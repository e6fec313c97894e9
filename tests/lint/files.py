# SPDX-License-Identifier: Apache-2.0
"""Rules for single files: licence line, include guard, no machine-specific paths, no sleeping and no shared files in tests."""
import re

import workspace

LICENCE = "SPDX-License-Identifier: Apache-2.0"
TEXT_SUFFIXES = {".cpp", ".hpp", ".py", ".sh", ".md", ".txt", ".cmake", ".xml", ".yaml", ".yml", ".json", ".meta", ".idl", ".in", ".supp", ""}
MACHINE_PATH = re.compile(r"(?<![\w.$}/-])/(?:work|home|root|Users)/\w|/tmp/[p]anvo\b|file:/[/]/")
# Polling every few milliseconds with a limit is permitted.
POLLING = r"(?!\(std::chrono::milliseconds\((?:[1-9]|10)\)\))"
WAITING = re.compile(rf"\bsleep_(?:for|until)\b{POLLING}|\b(?:u|nano)?sleep\s*\(|--repeat until-pass")
# Tests of one program run as several processes at the same time, which would share a file of a fixed name.
FIXED_NAME = re.compile(r"\btemp_directory_path\(\) /|\bTempDir\(\)")


def needs_licence(path):
    return path.suffix in {".cpp", ".hpp", ".py", ".sh", ".idl"} or path.parts[0] == ".ci" or str(path) == "launch_scripts/panvo"


def check(root):
    complaints = []
    for path in workspace.source_files(root):
        if path.suffix not in TEXT_SUFFIXES or path.name == "LICENSE":
            continue
        text = workspace.read(root, path)
        if "\0" in text:
            continue
        lines = text.splitlines()
        if needs_licence(path) and not any(LICENCE in line for line in lines[:2]):
            complaints.append(f"{path}:1: the file must begin with: {LICENCE}")
        if path.suffix == ".hpp" and "#pragma once" not in lines[:12]:
            complaints.append(f"{path}:1: a header must start with #pragma once")
        if lines and not text.endswith("\n"):
            complaints.append(f"{path}:{len(lines)}: no newline at end of file")
        is_a_test = path.parts[0] != "launch_scripts" and path.suffix in (".cpp", ".hpp") and ("test" in path.parts or path.parts[0] == "tests")
        code = workspace.without_comments(text).splitlines() if is_a_test else []
        for number, line in enumerate(lines, 1):
            if MACHINE_PATH.search(line):
                complaints.append(f"{path}:{number}: machine-specific path: {MACHINE_PATH.search(line)[0]}")
            if line != line.rstrip() and path.suffix != ".md":
                complaints.append(f"{path}:{number}: trailing white space")
            if is_a_test and WAITING.search(code[number - 1]):
                complaints.append(f"{path}:{number}: a test must wait for an event, not for time: {WAITING.search(code[number - 1])[0]}")
            if is_a_test and FIXED_NAME.search(code[number - 1]):
                complaints.append(f"{path}:{number}: tests run at the same time: take a folder from panvo/test/temporary_folder.hpp")
    return complaints


if __name__ == "__main__":
    workspace.run(check)
