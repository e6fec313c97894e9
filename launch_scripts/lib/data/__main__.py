# SPDX-License-Identifier: Apache-2.0
"""panvo data: names public recordings, unpacks downloaded archives, and checks recordings. Downloads nothing."""
import argparse
import pathlib
import shlex
import sys

import archives
import catalogue
import layouts

MARK = ".panvo_unpacked"  # in folders that `prepare` made, which it may write into again
LOOKED_FOR = "EuRoC/ASL (mav0/cam0), KITTI odometry (image_0, image_1, or image_2, image_3), left/ and right/, and those of `panvo data`"
LAST_LINES = """\
Stereo pair and panorama together, ready to run:
  panvo simulate short --out DIR; panvo run enhanced_vo --dataset DIR --out runs/short
  or a recording of your own in the EuRoC layout with equirectangular images in cam2

panvo data prepare ARCHIVE... unpacks and checks a download; panvo data check DIR checks what is unpacked."""


def fail(message, status=1):
    print(f"panvo data: {message}", file=sys.stderr)
    sys.exit(status)


def commands(findings):
    """How to run a recording, line by line."""
    folder, name = shlex.quote(str(findings.folder)), shlex.quote(f"runs/{findings.folder.resolve().name}")
    lines = [f"panvo run {'enhanced_vo' if findings.has_panorama else 'stereo'} --dataset {folder} --out {name}"]
    if findings.has_truth:
        lines.append(f"panvo evaluate {name} {folder}")
    return lines


def show(folder, key):
    """Checks one recording and prints the result. Returns whether it can be played."""
    if key not in layouts.READABLE:
        print(f"{folder}: {catalogue.conversion(key)}")
        return False
    name, check_layout = layouts.READABLE[key]
    print(f"{folder}: {name}")
    findings = check_layout(folder)
    for line in findings.facts:
        print(f"  {line}")
    for line in findings.notes:
        print(f"  note: {line}")
    for line in findings.problems:
        print(f"  PROBLEM: {line}")
    if findings.problems or not findings.has_stereo:
        return False
    for line in commands(findings):
        print(f"  run: {line}")
    return True


def check(folder):
    if not folder.is_dir():
        fail(f"folder '{folder}' not found", 2)
    found = layouts.recordings(folder)
    if not found:
        fail(f"'{folder}' holds no recording of a known layout; looked for {LOOKED_FOR}")
    good = [show(*recording) for recording in found]
    if len(good) > 1:
        print(f"{sum(good)} of {len(good)} recordings can be played")
    return 0 if all(good) else 1


def prepare(sources, out):
    for source in sources:
        if not source.exists():
            fail(f"'{source}' not found", 2)
    if len(sources) == 1 and sources[0].is_dir():
        packed = sorted(entry for entry in sources[0].iterdir() if archives.is_archive(entry))
        if not packed:
            return check(sources[0])
        sources = packed
    for source in sources:
        recognise(source)
    out = out or pathlib.Path(archives.stem(sources[0]))
    if out.exists() and (not out.is_dir() or any(out.iterdir()) and not (out / MARK).exists()):
        fail(f"'{out}' exists and was not made by `panvo data prepare`; choose a new folder with --out", 2)
    try:
        out.mkdir(parents=True, exist_ok=True)
        (out / MARK).touch()
        for source in sources:
            print(f"unpacking {source} into {out}", flush=True)
            print(f"  {archives.unpack(source, out)} files", flush=True)
    except (archives.ArchiveError, OSError) as error:
        fail(str(error))
    return check(out)


def recognise(source):
    """Fails unless the archive is of a data set that panvo can read. Nothing has been unpacked yet."""
    if not archives.is_archive(source):
        fail(f"'{source}' is neither a folder nor an archive ({', '.join(archives.SUFFIXES)})", 2)
    try:
        key = archives.data_set_of(source)
    except archives.ArchiveError as error:
        fail(str(error))
    if not key:
        fail(f"'{source}' holds no recording of a known layout; looked for {LOOKED_FOR}")
    if catalogue.conversion(key):
        fail(f"{source}: {catalogue.conversion(key)}. Nothing was unpacked")
    print(f"{source}: {catalogue.DATA_SETS[key].name}")


def main():
    parser = argparse.ArgumentParser(prog="panvo data", description=__doc__)
    verbs = parser.add_subparsers(dest="verb")
    checking = verbs.add_parser("check", help="check the recordings in a folder")
    checking.add_argument("folder", type=pathlib.Path)
    preparing = verbs.add_parser("prepare", help="unpack downloaded archives, then check")
    preparing.add_argument("sources", type=pathlib.Path, nargs="+", metavar="ARCHIVE|DIR")
    preparing.add_argument("--out", type=pathlib.Path, help="new folder (default: named after the first archive)")
    arguments = parser.parse_args()
    if arguments.verb == "check":
        return check(arguments.folder)
    if arguments.verb == "prepare":
        return prepare(arguments.sources, arguments.out)
    print(catalogue.described())
    print(LAST_LINES)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
