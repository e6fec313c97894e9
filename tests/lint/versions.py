# SPDX-License-Identifier: Apache-2.0
"""All packages have the version of project(panvo VERSION ...) in the root CMakeLists.txt; --fix writes it everywhere else."""
import argparse
import pathlib
import re
import sys

import workspace

NUMBER = r"\d+\.\d+\.\d+"
ROOT = re.compile(rf"project\(panvo VERSION ({NUMBER})")
# Each pattern keeps what stands before the version in group 1 and the version in group 2.
PROJECT = re.compile(r"(project\(\s*panvo_[\w<>]+\s+VERSION\s+)([^\s)]+)")
MANIFEST = re.compile(r"(<version>)([^<]*)")
RELEASE = re.compile(rf"^## \[({NUMBER})\]", re.MULTILINE)


def version_of(root):
    return ROOT.search(workspace.read(root, "CMakeLists.txt"))[1]


def places(root):
    """(file, pattern) of every copy of the version."""
    for folder in workspace.package_folders(root):
        yield folder / "CMakeLists.txt", PROJECT
        yield folder / "package.xml", MANIFEST
    yield pathlib.Path("interfaces/idl/panvo_msgs/package.xml"), MANIFEST
    yield pathlib.Path("CONTRIBUTING.md"), PROJECT  # its example of a package


def check(root):
    version = version_of(root)
    complaints = []
    for path, pattern in places(root):
        if not (root / path).is_file():
            continue
        found = pattern.search(workspace.read(root, path))
        if not found:
            complaints.append(f"{path}: has no version")
        elif found[2] != version:
            complaints.append(f"{path}: version {found[2]}, that of the workspace is {version}; tests/lint/versions.py --fix corrects it")
    changes = root / "CHANGELOG.md"
    if changes.is_file():
        released = RELEASE.search(workspace.read(root, changes.name))
        newest = released[1] if released else "none"
        if newest != version:
            complaints.append(f"{changes.name}: the newest release is {newest}, the version of the workspace is {version}")
    return complaints


def fix(root):
    version = version_of(root)
    for path, pattern in places(root):
        if (root / path).is_file():
            text = workspace.read(root, path)
            (root / path).write_text(pattern.sub(rf"\g<1>{version}", text, count=1), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path, nargs="?", default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--fix", action="store_true", help="correct the files; the changelog is left alone")
    arguments = parser.parse_args()
    if arguments.fix:
        fix(arguments.root)
    sys.argv[1:] = [str(arguments.root)]
    workspace.run(check)


if __name__ == "__main__":
    main()
