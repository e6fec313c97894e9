# SPDX-License-Identifier: Apache-2.0
"""Layers of the architecture (here: floors): checks every #include, and threads and clocks where they are forbidden.

The link graph enforces much of this, but not header-only use and headers of indirect dependencies.
"""
import dataclasses
import pathlib
import re

import workspace

# Library of an include path, by its first part.
LIBRARIES = {
    "Eigen": "eigen", "unsupported": "eigen", "opencv2": "opencv", "ceres": "ceres", "opengv": "opengv",
    "fastdds": "fastdds", "fastrtps": "fastdds",
    "yaml-cpp": "yaml", "spdlog": "log", "fmt": "text", "CLI": "command line", "nlohmann": "json",
    "sqlite3.h": "sqlite", "libpq-fe.h": "libpq", "tinyxml2.h": "xml", "systemd": "systemd", "zlib.h": "zlib",
    "civetweb.h": "civetweb", "embree3": "embree", "arv.h": "aravis", "glib.h": "aravis", "glib-object.h": "aravis",
    "pybind11": "python",
    "gtest": "test", "gmock": "test", "benchmark": "test",
}
THREAD_HEADERS = {"thread", "future", "stop_token", "condition_variable", "mutex", "shared_mutex", "semaphore", "latch", "barrier", "pthread.h"}
CLOCK_HEADERS = {"chrono", "ctime", "time.h", "sys/time.h"}
THREADS_OR_CLOCKS = re.compile(
    r"\bstd::(?:jthread|thread|async|mutex)\b|\bpthread_create\b|\bsleep_(?:for|until)\b|\b(?:steady|system|high_resolution)_clock\b"
    r"|\bclock_gettime\b|\bgettimeofday\b|\bgetTickCount\b|\bstd::(?:time|clock)\s*\(")
POSIX = re.compile(r"^(?:[a-z_0-9]+/)*[a-z_0-9]+\.h$")
PRODUCT = re.compile(r"panvo_msgs/|panvo/interfaces/topics\.hpp")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


@dataclasses.dataclass(frozen=True)
class Floor:
    name: str
    packages: frozenset  # panvo packages, besides its own
    libraries: frozenset  # third-party, and "messages" for generated types
    threads_and_clocks: bool = True


def floor(name, packages="", libraries="", threads_and_clocks=True):
    return Floor(name, frozenset(packages.split()), frozenset(map(str.strip, libraries.split(","))) | {"text"}, threads_and_clocks)


VISION = floor("vision", "", "eigen, opencv", False)
CALIBRATION_FILES = floor("calibration files", "vision", "eigen, yaml", False)
INTERFACES = floor("interfaces", "", "messages")
SQLITE = floor("sqlite", "", "sqlite")
# connections, and the thread that waits for a server in place of a component
POSTGRES = floor("postgres", "", "libpq")
RUNTIME = floor("runtime", "interfaces", "messages, log, command line")
RUNTIME_DDS = floor("runtime's dds", "interfaces", "messages, fastdds, log")
RUNTIME_CONFIG = floor("runtime's config", "interfaces", "messages, yaml, log, command line")
RUNNER = floor("runner", "runtime interfaces", "messages, log, json, command line, systemd")
CONVERSIONS = floor("conversions", "interfaces vision runtime", "messages, eigen, opencv")
# from image messages to compressed ones and back
COMPRESSED_IMAGES = floor("compressed images", "runtime interfaces conversions", "messages, opencv", False)
ALGORITHM = floor("algorithm", "vision landmarks", "eigen, opencv, ceres, opengv", False)
WRAPPER = floor("component wrapper", "runtime interfaces conversions vision calibration_files landmarks", "messages, eigen, opencv", False)
# places, their store and their messages
LANDMARKS = floor("landmarks", "vision interfaces conversions runtime sqlite postgres", "messages, eigen, opencv, sqlite, json", False)
# programs of a package
TOOL = floor("tool", "vision calibration_files", "eigen, opencv, command line")
# readers of rig files
RIG_FILE = floor("rig file", "vision calibration_files", "eigen, opencv", False)
# readers of images from a bag
BAG_IMAGES = floor("images of a bag", "recorder interfaces conversions", "messages, opencv, command line", False)
# readers of images from live topics
LIVE_IMAGES = floor("images of topics", "runtime interfaces conversions", "messages, opencv")
RECORDER = floor("recorder", "runtime interfaces sqlite", "messages, fastdds, yaml, sqlite, zlib, log, json, command line")
# a server, with the threads of its connections
WEB_VIEW = floor("web view", "runtime interfaces compressed_images", "messages, json, civetweb")
DRIVER = floor("driver", "runtime interfaces conversions vision calibration_files", "messages, eigen, opencv, xml, json, log")
CAMERA_DRIVER = floor("camera driver", "runtime interfaces conversions vision calibration_files camera_stream camera_group",
                      "messages, eigen, opencv, aravis, json, log")
SIMULATED_WORLD = floor("simulated world", "vision", "eigen, opencv, embree")
SIMULATION = floor("simulation", "runtime interfaces conversions vision calibration_files simulated_world", "messages, eigen, opencv, yaml, command line")
# the Python module: converts arrays and calls the libraries
PYTHON = floor("python", "interfaces conversions vision calibration_files recorder dataset_player binocular_odometry landmarks position_corrector"
               " panoramic_compass evaluation", "messages, eigen, opencv, python")
# recognition in folders of images, with the readers of their files
PLACES = floor("places", "vision landmarks landmark_builder position_corrector dataset_player sqlite", "eigen, opencv, opengv, sqlite, json, command line", False)
# places of a stereo camera: their algorithm, and its component
STEREO_PLACES = floor("stereo places", "vision landmarks position_corrector places", "eigen, opencv", False)
STEREO_PLACES_WRAPPER = floor("stereo places' wrapper", "runtime interfaces conversions vision landmarks position_corrector", "messages, eigen, opencv", False)
# robots that share places; recognition as in the position corrector
FLEET = floor("fleet", "vision landmarks position_corrector", "eigen, opencv", False)
FLEET_WRAPPER = floor("fleet's component", "runtime interfaces conversions vision landmarks position_corrector", "messages, eigen, opencv", False)
EVALUATION = None  # may include anything

# Folders that do not consist of an algorithm and its wrapper; the first match counts.
FLOORS = [
    ("components/vision", VISION),
    ("components/calibration_files", CALIBRATION_FILES),
    ("interfaces", INTERFACES),
    ("components/sqlite", SQLITE),
    ("components/postgres", POSTGRES),
    ("components/runtime/src/dds", RUNTIME_DDS),
    ("components/runtime/src/config", RUNTIME_CONFIG),
    ("components/runtime", RUNTIME),
    ("components/runner", RUNNER),
    ("components/conversions", CONVERSIONS),
    ("components/compressed_images", COMPRESSED_IMAGES),
    ("components/landmarks", LANDMARKS),
    ("components/panorama_stitcher/src/rig", RIG_FILE),
    ("components/calibration/src/files", RIG_FILE),
    ("components/calibration/src/bag", BAG_IMAGES),
    ("components/calibration/src/messages", BAG_IMAGES),
    ("components/calibration/src/live", LIVE_IMAGES),
    ("components/recorder", RECORDER),
    ("components/web_view", WEB_VIEW),
    ("components/places", PLACES),
    ("components/stereo_places/src/stereo_places_component.cpp", STEREO_PLACES_WRAPPER),
    ("components/stereo_places", STEREO_PLACES),
    ("components/fleet/include", FLEET),
    ("components/fleet/src/fleet_component.cpp", FLEET_WRAPPER),
    ("components/fleet/src/fleet_messages.cpp", FLEET_WRAPPER),
    ("components/fleet/src/fleet_messages.hpp", FLEET_WRAPPER),
    ("components/fleet/src/fleet_pose_publisher.cpp", FLEET_WRAPPER),
    ("components/fleet/src/fleet_pose_publisher.hpp", FLEET_WRAPPER),
    ("components/fleet", FLEET),
    ("components/evaluation", EVALUATION),
    ("components/python", PYTHON),
    ("drivers/simulated_world", SIMULATED_WORLD),
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
    """Sources that CMakeLists.txt files of components compile into plugins, without suffix, so that headers match, too."""
    found = set()
    for lists in pathlib.Path(root).glob("components/*/CMakeLists.txt"):
        for sources in re.findall(r"panvo_add_component\([^)]*?SOURCES((?:\s+[\w/.-]+)+?)(?:\s+(?:LINK|NO_INSTALL)\b|\s*\))", lists.read_text(encoding="utf-8")):
            folder = lists.parent.relative_to(root)
            found |= {(folder / source).with_suffix("") for source in sources.split()}
    return found


def floor_of(path, wrappers=frozenset()):
    if path.parts[0] == "components" and "/".join(path.parts[:2]) not in OWN_FLOOR and (
            path.stem.endswith(("_component", "_messages")) or path.with_suffix("") in wrappers):
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
    """Packages of messages: those of panvo, the other ones of ROS 2, and those of tests."""
    folders = [pathlib.Path(root) / "interfaces" / name for name in ("idl", "common", "test/packages")]
    return {entry.name for folder in folders if folder.is_dir() for entry in folder.iterdir() if entry.is_dir()}


def belongs_to(include, messages):
    """("package", name), ("library", name) or ("standard", header) of an include path; None if unknown."""
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
    """Whether the file is in the folder of the including file or in a source folder of its package."""
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
        return 'leaves its package; public headers are "panvo/<package>/..."'
    if its_floor in (RUNTIME, RUNTIME_DDS, RUNTIME_CONFIG) and PRODUCT.match(include) and not is_test(path):
        return "the runtime knows no topic and no message of panvo's components"
    kind = belongs_to(include, messages)
    if kind is None:
        return "unknown library; add it to LIBRARIES in tests/lint/floors.py and to the layers that may use it"
    what, name = kind
    if what == "package":
        if name == its_package or is_test(path):
            return None
        if name in NOBODY_INCLUDES and name not in its_floor.packages:
            return f"nothing may include {name}"
        if name not in its_floor.packages:
            return f"layer '{its_floor.name}' may include only these panvo packages: {', '.join(sorted(its_floor.packages)) or 'none'}"
    elif what == "library":
        if name == "command line" and path.name == "main.cpp" or is_test(path):
            return None
        if name not in its_floor.libraries:
            return f"layer '{its_floor.name}' may not use {name}; it may use: {', '.join(sorted(its_floor.libraries))}"
    elif not its_floor.threads_and_clocks and not is_test(path):
        if name in THREAD_HEADERS:
            return f"layer '{its_floor.name}' may not use threads: the runtime gives each component one"
        if name in CLOCK_HEADERS:
            return f"layer '{its_floor.name}' may not read clocks: time is the stamp of the processed message"
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
                complaints.append(f"{path}:{number}: {found}: layer '{its_floor.name}' may not use threads or read clocks")
    return complaints


if __name__ == "__main__":
    workspace.run(check)
