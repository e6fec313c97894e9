#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packs an installed panvo module and the panvo libraries it needs into a wheel.

    cmake --install build/release --prefix PREFIX && make_wheel.py PREFIX --out dist
    pip install dist/panvo-*.whl

The wheel is for the interpreter that the module was built for and for this distribution: the libraries of OpenCV and others stay Debian's.
"""
import argparse
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import zipfile

PACKAGE = "lib/python3*/*-packages/panvo"  # dist-packages from a Debian package


def needed_libraries(module, prefix):
    """panvo's own libraries among those that a module loads, and the message libraries beside them."""
    listing = subprocess.run(["ldd", module], check=True, capture_output=True, text=True).stdout
    missing = re.findall(r"^\s*(\S+) => not found", listing, re.MULTILINE)
    if missing:
        sys.exit(f"make_wheel: {module} lacks {', '.join(missing)}; install panvo's other packages to {prefix} as well")
    libraries = [pathlib.Path(path) for name, path in re.findall(r"^\s*(\S+) => (\S+)", listing, re.MULTILINE) if name.startswith("libpanvo_")]
    outside = [str(path) for path in libraries if not path.resolve().is_relative_to(prefix)]
    if outside:
        sys.exit(f"make_wheel: {', '.join(outside)}: not in {prefix}; install to one prefix (colcon: --merge-install)")
    folders = {path.parent for path in libraries}
    return libraries + sorted(file for folder in folders for file in folder.glob("lib*__panvo.so"))


def version_of(prefix):
    manifest = prefix / "share/panvo_python/package.xml"
    return re.search(r"<version>([^<]+)", manifest.read_text(encoding="utf-8"))[1]


def metadata(version, tag):
    return {
        "METADATA": f"Metadata-Version: 2.1\nName: panvo\nVersion: {version}\nSummary: Visual odometry with drift correction\n"
                    "License: Apache-2.0\nRequires-Python: >=3.9\nRequires-Dist: numpy\n",
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: make_wheel.py\nRoot-Is-Purelib: false\nTag: {tag}\n",
        "top_level.txt": "panvo\n",
    }


def tag_of(module):
    """Interpreter, binary interface and platform of a module: "cp311-cp311-linux_x86_64" of _core.cpython-311-x86_64-linux-gnu.so."""
    interpreter = re.match(r"_core\.cpython-(\d+)-", module.name)
    if not interpreter:
        sys.exit(f"make_wheel: {module}: not a module for CPython")
    return f"cp{interpreter[1]}-cp{interpreter[1]}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def write_wheel(path, contents):
    """Equal contents give an equal file. RECORD is the last entry."""
    record = []
    info = next(name for name in contents if name.endswith(".dist-info/WHEEL")).rsplit("/", 1)[0]
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        def add(name, data):
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
        for name, data in sorted(contents.items()):
            add(name, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{name},sha256={digest},{len(data)}\n")
        add(f"{info}/RECORD", "".join(record) + f"{info}/RECORD,,\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("prefix", type=pathlib.Path, help="where panvo is installed")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("dist"), help="folder for the wheel (default: dist)")
    arguments = parser.parse_args()
    prefix = arguments.prefix.resolve()
    modules = sorted(prefix.glob(f"{PACKAGE}/_core*.so"))
    if not modules:
        sys.exit(f"make_wheel: {prefix}/{PACKAGE}: no module _core; build with pybind11-dev, then cmake --install BUILD --prefix {prefix}")
    version, tag = version_of(prefix), tag_of(modules[0])
    contents = {f"panvo/{file.name}": file.read_bytes() for file in modules[0].parent.iterdir() if file.is_file()}
    for library in needed_libraries(modules[0], prefix):
        contents[f"panvo/{library.name}"] = library.read_bytes()
    contents.update({f"panvo-{version}.dist-info/{name}": text.encode() for name, text in metadata(version, tag).items()})
    os.makedirs(arguments.out, exist_ok=True)
    wheel = arguments.out / f"panvo-{version}-{tag}.whl"
    write_wheel(wheel, contents)
    print(wheel)


if __name__ == "__main__":
    main()
