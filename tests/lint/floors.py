# SPDX-License-Identifier: Apache-2.0
"""Who may know whom: every #include against the floors of the architecture, and threads and clocks where there may be none.

The link graph enforces much of this; headers that need no linking, and what a library drags in, only show here.
"""
import dataclasses
import pathlib
import re

import workspace

# What an include path belongs to, by its first part.
LIBRARIES = {
    "Eigen": "eigen", "unsupported": "eigen", "opencv2": "opencv", "ceres": "ceres", "opengv": "opengv",
    "fastdds": "fastdds", "fastrtps": "fastdds", "fastcdr": "fastdds",
    "yaml-cpp": "yaml", "spdlog": "log", "fmt": "text", "CLI": "command line", "nlohmann": "json", "sqlite3.h": "sqlite", "tinyxml2.h": "xml",
    "embree3": "embree", "arv.h": "aravis", "glib.h": "aravis", "glib-object.h": "aravis",
    "gtest": "test", "gmock": "test", "benchmark": "test",
}
THREAD_HEADERS = {"thread", "future", "stop_token", "condition_variable", "mutex", "shared_mutex", "semaphore", "latch", "barrier", "pthread.h"}
CLOCK_HEADERS = {"chrono", "ctime", "time.h", "sys/time.h"}
THREADS_OR_CLOCKS = re.compile(
    r"\bstd::(?:jthread|thread|async|mutex)\b|\bpthread_create\b|\bsleep_(?:for|until)\b|\b(?:steady|system|high_resolution)_clock\b"
    r"|\bclock_gettime\b|\bgettimeofday\b|\bgetTickCount\b|\bstd::(?:time|clock)\s*\(")
POSIX = re.compile(r"^(?:[a-z_0-9]+/)*[a-z_0-9]+\.h$")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


@dataclasses.dataclass(frozen=True)
class Floor:
    name: str
    packages: frozenset  # of ours, beside its own
    libraries: frozenset  # third-party, and "messages" for generated types
    threads_and_clocks: bool = True


def floor(name, packages="", libraries="", threads_and_clocks=True):
    return Floor(name, frozenset(packages.split()), frozenset(map(str.strip, libraries.split(","))) | {"text"}, threads_and_clocks)


VISION = floor("vision", "", "eigen, opencv", False)
INTERFACES = floor("interfaces", "", "messages, fastdds")
RUNTIME = floor("runtime", "interfaces", "messages, log, json, command line")
RUNTIME_DDS = floor("runtime's dds", "interfaces", "messages, fastdds, log, json")
RUNTIME_CONFIG = floor("runtime's config", "interfaces", "messages, yaml, log, json, command line")
CONVERSIONS = floor("conversions", "interfaces vision runtime", "messages, eigen, opencv")
ALGORITHM = floor("algorithm", "vision landmarks", "eigen, opencv, ceres, opengv", False)
WRAPPER = floor("component wrapper", "runtime interfaces conversions vision landmarks", "messages, eigen, opencv", False)
# places, the store that keeps them and their messages
LANDMARKS = floor("landmarks", "vision interfaces conversions runtime", "messages, eigen, opencv, sqlite, json", False)
# programs of a package, beside its algorithm and its component
TOOL = floor("tool", "vision landmarks", "eigen, opencv, yaml, json, command line")
# rig files of a stitcher, beside its algorithm
RIG_FILE = floor("rig file", "vision", "eigen, opencv, yaml", False)
# images of a bag, beside an algorithm that takes files
BAG_IMAGES = floor("images of a bag", "recorder interfaces conversions", "messages, opencv, command line", False)
# and of live topics
LIVE_IMAGES = floor("images of topics", "runtime interfaces conversions", "messages, opencv")
RECORDER = floor("recorder", "runtime interfaces", "messages, fastdds, yaml, sqlite, log, json, command line")
DRIVER = floor("driver", "runtime interfaces conversions vision", "messages, eigen, opencv, yaml, xml, json, log")
CAMERA_DRIVER = floor("camera driver", "runtime interfaces conversions vision camera_stream camera_group", "messages, eigen, opencv, aravis, yaml, json, log")
SIMULATION = floor("simulation", "runtime interfaces conversions vision", "messages, eigen, opencv, embree, yaml, log, command line")
EVALUATION = None  # may include anything

# Folders whose files are not an algorithm and its wrapper.
FLOORS = [
    ("components/vision", VISION),
    ("interfaces", INTERFACES),
    ("components/runtime/src/dds", RUNTIME_DDS),
    ("components/runtime/src/config", RUNTIME_CONFIG),
    ("components/runtime", RUNTIME),
    ("components/conversions", CONVERSIONS),
    ("components/landmarks", LANDMARKS),
    ("components/panorama_stitcher/src/rig", RIG_FILE),
    ("components/calibration/src/files", RIG_FILE),
    ("components/calibration/src/bag", BAG_IMAGES),
    ("components/calibration/src/messages", BAG_IMAGES),
    ("components/calibration/src/live", LIVE_IMAGES),
    ("components/recorder", RECORDER),
    ("components/evaluation", EVALUATION),
    ("drivers/simulation", SIMULATION),
    ("drivers/camera_group", CAMERA_DRIVER),
    ("drivers/aravis_camera", CAMERA_DRIVER),
    ("drivers/v4l2_camera", CAMERA_DRIVER),
    ("drivers", DRIVER),
    ("tests", EVALUATION),
]
NOBODY_INCLUDES = {"evaluation", "tests"}


OWN_FLOOR = {folder for folder, _ in FLOORS}


def wrapper_sources(root):
    """What the components' CMakeLists.txt compile into plugins, without suffix, so that a header goes with its source."""
    found = set()
    for lists in pathlib.Path(root).glob("components/*/CMakeLists.txt"):
        for sources in re.findall(r"panvo_add_component\([^)]*?SOURCES((?:\s+[\w/.-]+)+?)(?:\s+(?:LINK|NO_INSTALL)\b|\s*\))", lists.read_text(encoding="utf-8")):
            folder = lists.parent.relative_to(root)
            found |= {(folder / source).with_suffix("") for source in sources.split()}
    return found


def floor_of(path, wrappers=frozenset()):
    if path.parts[0] == "components" and "/".join(path.parts[:2]) not in OWN_FLOOR and (
            path.stem.endswith("_component") or path.with_suffix("") in wrappers):
        return WRAPPER
    if path.parts[0] == "components" and "/".join(path.parts[:2]) not in OWN_FLOOR and path.parts[2:3] == ("tools",):
        return TOOL
    for folder, its_floor in FLOORS:
        if path.is_relative_to(folder):
            return its_floor
    return ALGORITHM if path.parts[0] == "components" else None


def package_of(path):
    return path.parts[1] if path.parts[0] in ("components", "drivers") else path.parts[0]


def message_packages(root):
    idl = pathlib.Path(root) / "interfaces" / "idl"
    return {entry.name for entry in idl.iterdir() if entry.is_dir()} if idl.is_dir() else set()


def belongs_to(include, messages):
    """("package", name), ("library", name) or ("standard", header) of an include path; None for one nobody knows."""
    first = include.split("/")[0]
    if first == "panvo":
        return "package", include.split("/")[1]
    if first in messages and "/" in include:
        return "library", "messages"
    if first in LIBRARIES:
        return "library", LIBRARIES[first]
    if "." not in include or POSIX.match(include):
        return "standard", include
    return None


def is_local(root, path, include):
    """A file beside the one that includes it, or in one of the folders of its own package."""
    depth = 2 if path.parts[0] in ("components", "drivers") else 1
    package = pathlib.Path(root, *path.parts[:depth])
    folders = [pathlib.Path(root) / path.parent, *(package / name for name in ("src", "test", "tools"))]
    return any((folder / include).is_file() and (folder / include).resolve().is_relative_to(package.resolve()) for folder in folders)


def is_test(path):
    return "test" in path.parts or path.parts[0] == "tests"


def complaint_of_include(root, path, its_floor, quoted, include, messages):
    its_package = package_of(path)
    if quoted and is_local(root, path, include):
        return None
    if quoted and ".." in include.split("/"):
        return 'climbs out of its package; public headers are "panvo/<package>/..."'
    kind = belongs_to(include, messages)
    if kind is None:
        return "belongs to no known library; add it to LIBRARIES in tests/lint/floors.py, on the floors that may use it"
    what, name = kind
    if what == "package":
        if name == its_package or is_test(path):
            return None
        if name in NOBODY_INCLUDES:
            return f"nothing includes {name}"
        if name not in its_floor.packages:
            return f"the floor '{its_floor.name}' may include of ours only: {', '.join(sorted(its_floor.packages)) or 'nothing'}"
    elif what == "library":
        if name == "command line" and path.name == "main.cpp" or is_test(path):
            return None
        if name not in its_floor.libraries:
            return f"the floor '{its_floor.name}' does not use {name}; it may use: {', '.join(sorted(its_floor.libraries))}"
    elif not its_floor.threads_and_clocks and not is_test(path):
        if name in THREAD_HEADERS:
            return f"the floor '{its_floor.name}' has no threads of its own: the runtime gives each component one"
        if name in CLOCK_HEADERS:
            return f"the floor '{its_floor.name}' reads no clock: time is the stamp of what is being processed"
    return None


def check(root):
    messages, wrappers = message_packages(root), wrapper_sources(root)
    complaints = []
    for path in workspace.cpp_files(root):
        its_floor = floor_of(path, wrappers)
        if its_floor is None:
            continue
        text = workspace.read(root, path)
        code = workspace.without_comments(text).splitlines()
        for number, line in enumerate(text.splitlines(), 1):
            match = INCLUDE.match(line)
            if match:
                why = complaint_of_include(root, path, its_floor, match[1] == '"', match[2], messages)
                if why:
                    complaints.append(f"{path}:{number}: {match[2]}: {why}")
            elif not its_floor.threads_and_clocks and not is_test(path) and THREADS_OR_CLOCKS.search(code[number - 1]):
                found = THREADS_OR_CLOCKS.search(code[number - 1])[0]
                complaints.append(f"{path}:{number}: {found}: the floor '{its_floor.name}' has no threads of its own and reads no clock")
    return complaints


if __name__ == "__main__":
    workspace.run(check)
