# SPDX-License-Identifier: Apache-2.0
"""Lists and reads the files of a workspace for the rules, and reports complaints."""
import os
import pathlib
import re
import sys

NOT_SOURCE = {"build", "install", "log", "runs"}  # at the root only
CPP_SUFFIXES = {".cpp", ".hpp"}


def source_files(root):
    """All files of the workspace, sorted, as paths relative to its root; without results of builds and runs."""
    root = pathlib.Path(root)
    found = []
    for folder, folders, names in os.walk(root):
        here = pathlib.Path(folder)
        folders[:] = sorted(
            name for name in folders
            if name not in {".git", ".cache", "__pycache__"} and not (here == root and name in NOT_SOURCE))
        found += [(here / name).relative_to(root) for name in names]
    return sorted(found)


def cpp_files(root):
    return [path for path in source_files(root) if path.suffix in CPP_SUFFIXES]


def read(root, path):
    return (pathlib.Path(root) / path).read_text(encoding="utf-8", errors="replace")


def package_folders(root):
    """Folders that must be packages: all in components/ and drivers/, and some at the root."""
    root = pathlib.Path(root)
    folders = [pathlib.Path(name) for name in ("config/build", "interfaces", "launch_scripts", "tests") if (root / name).is_dir()]
    for group in ("components", "drivers"):
        if (root / group).is_dir():
            folders += sorted(entry.relative_to(root) for entry in (root / group).iterdir() if entry.is_dir())
    return folders


def without_comments(text):
    """C++ text with comments and contents of string literals replaced by spaces; line numbers are preserved."""

    def blank(match):
        token = match.group(0)
        if token.startswith("/"):
            return re.sub(r"[^\n]", " ", token)
        return token[0] + re.sub(r"[^\n]", " ", token[1:-1]) + token[-1]

    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', blank, text, flags=re.DOTALL)


def run(check):
    """Runs check(root) as a program: complaints on stderr, exit status 1 if there are any."""
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    complaints = check(root)
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    if complaints:
        print(f"{len(complaints)} violations", file=sys.stderr)
    sys.exit(1 if complaints else 0)
