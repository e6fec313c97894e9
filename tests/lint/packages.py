# SPDX-License-Identifier: Apache-2.0
"""Every package is complete: known to CMake and colcon, with consistent package.xml and CMakeLists.txt."""
import pathlib
import re
import xml.etree.ElementTree as ElementTree

import workspace

METAS = ["colcon.meta", "config/build/asan.meta", "config/build/ubsan.meta", "config/build/tsan.meta"]
# CMake name of a library -> Debian package.
DEBIAN = {
    "Eigen3": "libeigen3-dev", "OpenCV": "libopencv-dev", "Ceres": "libceres-dev", "opengv": "libopengv-dev", "fastrtps": "libfastrtps-dev", "fastdds": "libfastdds-dev",
    "fastcdr": "libfastrtps-dev", "yaml-cpp": "libyaml-cpp-dev", "spdlog": "libspdlog-dev", "CLI11": "libcli11-dev",
    "nlohmann_json": "nlohmann-json3-dev", "SQLite3": "libsqlite3-dev", "PostgreSQL": "libpq-dev", "GTest": "libgtest-dev", "benchmark": "libbenchmark-dev",
    "fmt": "libfmt-dev", "OpenSSL": "libssl-dev", "CycloneDDS": "cyclonedds-dev", "PNG": "libpng-dev",
    "tinyxml2": "libtinyxml2-dev", "embree": "libembree-dev", "ZLIB": "zlib1g-dev",
    "Python3": "python3", "Python": "python3-dev", "pybind11": "pybind11-dev", "Threads": "g++", "PkgConfig": "pkg-config",
}


def is_of_inner_package(package, file):
    """Whether a file belongs to a package inside another, such as the one of messages for ROS 2."""
    return any((folder / "package.xml").is_file() for folder in file.parents if folder != package and folder.is_relative_to(package))


def cmake_text(root, folder):
    """Text of the CMakeLists.txt files of a package, without comments."""
    files = sorted(file for file in (root / folder).rglob("CMakeLists.txt") if not is_of_inner_package(root / folder, file))
    return re.sub(r"#[^\n]*", "", "\n".join(file.read_text(encoding="utf-8") for file in files))


def check_package(root, folder, order):
    complaints = []
    name = "panvo_" + folder.name
    manifest, lists = root / folder / "package.xml", root / folder / "CMakeLists.txt"
    for file in (manifest, lists):
        if not file.is_file():
            complaints.append(f"{folder}: has no {file.name}: every folder of code is a package")
    if complaints:
        return complaints
    described = ElementTree.parse(manifest).getroot()
    if described.findtext("name") != name:
        complaints.append(f"{folder}/package.xml: name is {described.findtext('name')}, must be {name}")
    if described.findtext("export/build_type") != "cmake":
        complaints.append(f"{folder}/package.xml: build_type must be cmake")
    project = re.search(r"project\(\s*(\S+)", lists.read_text(encoding="utf-8"))
    if not project or project[1] != name:
        complaints.append(f"{folder}/CMakeLists.txt: must contain project({name} ...)")
    if folder.parts[0] in ("components", "drivers") and not (root / folder / "README.md").is_file():
        complaints.append(f"{folder}: has no README.md")

    if str(folder) not in order:
        complaints.append(f"CMakeLists.txt: package_folders lacks {folder}")
        return complaints
    tags = [(tag.tag, tag.text) for tag in described if tag.tag.endswith("depend") and tag.text]
    depends = {text for _, text in tags}
    for tag, text in sorted({pair for pair in tags if tags.count(pair) > 1}):
        complaints.append(f"{folder}/package.xml: has <{tag}>{text} twice; colcon then ignores the whole file")
    found = set(re.findall(r"find_package\(\s*([\w-]+)", cmake_text(root, folder)))
    for used in sorted(found - depends):
        if used.startswith("panvo_"):
            complaints.append(f"{folder}/package.xml: CMakeLists.txt finds {used}, which has no depend tag; colcon would build in any order")
    by_name = {"panvo_" + pathlib.Path(other).name: position for position, other in enumerate(order)}
    for used in sorted(depends):
        if used.startswith("panvo_") and used not in by_name:
            complaints.append(f"{folder}/package.xml: depends on {used}, which is not a package of the workspace")
        elif used.startswith("panvo_") and by_name[used] >= by_name[name]:
            complaints.append(f"CMakeLists.txt: package_folders has {folder} before {used}, which it needs")
    return complaints


def check_test_folders(root):
    """Each folder in tests/ with a CMakeLists.txt must be listed in tests/CMakeLists.txt; otherwise its tests would never run."""
    top = root / "tests" / "CMakeLists.txt"
    if not top.is_file():
        return []
    named = set(re.findall(r"[\w]+", " ".join(re.findall(r"foreach\(folder IN ITEMS([^)]*)\)", top.read_text(encoding="utf-8")))))
    return [f"tests/CMakeLists.txt: does not list the folder {lists.parent.name}"
            for lists in sorted((root / "tests").glob("*/CMakeLists.txt")) if lists.parent.name not in named]


def check_test_sources(root, folder):
    """Each test source is named in a CMakeLists.txt, or one finds them all; otherwise its tests would never run."""
    text = cmake_text(root, folder)
    if re.search(r"GLOB[^)]*_test\.cpp", text):
        return []
    return [f"{file.relative_to(root)}: no CMakeLists.txt of the package names it: its tests never run"
            for file in sorted((root / folder).rglob("*_test.cpp"))
            if file.name not in text and not is_of_inner_package(root / folder, file)]


def check_debian_packages(root):
    list_file = root / "launch_scripts" / "packages.txt"
    if not list_file.is_file():
        return ["launch_scripts/packages.txt: is missing"]
    listed = {name for line in list_file.read_text(encoding="utf-8").splitlines() if re.match(r"[a-z]", line) for name in line.split()[0].split("|")}
    complaints = []
    for folder in workspace.package_folders(root):
        for used in sorted(set(re.findall(r"find_package\(\s*([\w-]+)", cmake_text(root, folder)))):
            if used.startswith("panvo_"):
                continue
            if used not in DEBIAN:
                complaints.append(f"{folder}/CMakeLists.txt: finds {used}; say in tests/lint/packages.py which Debian package brings it")
            elif DEBIAN[used] not in listed:
                complaints.append(f"launch_scripts/packages.txt: lacks {DEBIAN[used]}, which {folder} needs")
    return complaints


def check(root):
    root = pathlib.Path(root)
    top = (root / "CMakeLists.txt").read_text(encoding="utf-8")
    order = re.search(r"set\(package_folders([^)]*)\)", top)[1].split()
    complaints = []
    folders = workspace.package_folders(root)
    for folder in folders:
        complaints += check_package(root, folder, order) + check_test_sources(root, folder)
    for folder in order:
        if pathlib.Path(folder) not in folders:
            complaints.append(f"CMakeLists.txt: package_folders lists {folder}, which does not exist")
    for meta in METAS:
        text = (root / meta).read_text(encoding="utf-8") if (root / meta).is_file() else ""
        for folder in folders:
            compiles = "CXX" in (root / folder / "CMakeLists.txt").read_text(encoding="utf-8") if (root / folder / "CMakeLists.txt").is_file() else False
            if compiles and not re.search(rf"^  panvo_{folder.name}:", text, re.MULTILINE):
                complaints.append(f"{meta}: lacks panvo_{folder.name}")
    return complaints + check_test_folders(root) + check_debian_packages(root)


if __name__ == "__main__":
    workspace.run(check)
