# SPDX-License-Identifier: Apache-2.0
"""Checks a recording in the EuRoC/ASL layout: images, data.csv, sensor.yaml, ground truth."""
import bisect
import re

import images
from findings import Findings, duration, in_px, numbers_of, rows_of


def check(folder):
    findings = Findings(folder)
    root = folder / "mav0" if (folder / "mav0").is_dir() else folder
    panorama = read_key(root / "cam2" / "sensor.yaml", "camera_model") == "equirectangular"
    is_panorama_only = panorama and not any((root / name).exists() for name in ("cam0", "cam1"))
    stamps = [] if is_panorama_only else check_stereo(findings, root)
    if panorama:
        panoramas = check_camera(findings, root / "cam2", ("resolution", "T_BS"))
        findings.has_panorama = bool(panoramas)
        stamps = stamps or panoramas
    elif (root / "cam2").is_dir():
        findings.notes.append("cam2 is not played: its camera_model is not equirectangular")
    check_truth(findings, root, stamps)
    if is_panorama_only:
        findings.notes.append("no stereo pair: panoramas alone give no odometry")
    return findings


def check_stereo(findings, root):
    """Stamps of the left images in ns."""
    keys = ("resolution", "intrinsics", "distortion_coefficients", "T_BS")
    left, right = (check_camera(findings, root / name, keys) for name in ("cam0", "cam1"))
    for name in ("cam0", "cam1"):
        model = read_key(root / name / "sensor.yaml", "camera_model")
        if model not in (None, "pinhole"):
            findings.problems.append(f"{name}/sensor.yaml: camera_model is {model}, must be pinhole (with any lens model)")
    common = len(set(left) & set(right))
    alone = len(left) + len(right) - 2 * common
    if left and right and common == 0:
        findings.notes.append("no stamps of cam0 and cam1 are equal: images are paired by the nearest stamp")
    elif alone:
        findings.notes.append(f"{alone} images of cam0 and cam1 have no partner of equal stamp")
    findings.has_stereo = bool(left and right)
    return left


def check_camera(findings, folder, keys):
    """Checks one camera. Returns its stamps in ns."""
    name = folder.name
    if not folder.is_dir():
        findings.problems.append(f"{name}/ is missing")
        return []
    stamps, files = read_list(findings, folder)
    size = findings.check_images(folder / "data", files)
    unlisted = set(images.images_in(folder / "data")) - set(files) if (folder / "data").is_dir() else set()
    if unlisted:
        findings.notes.append(f"{len(unlisted)} images of {name}/data are not in data.csv and are not played, for example {min(unlisted)}")
    sensor = folder / "sensor.yaml"
    if not sensor.is_file():
        findings.problems.append(f"{name}/sensor.yaml is missing: it holds the calibration")
    else:
        check_sensor(findings, sensor, keys, size)
    findings.facts.append(f"{name}: {len(files)} images, {in_px(size)}, {duration([stamp * 1e-9 for stamp in stamps])}")
    return stamps


def check_sensor(findings, file, keys, size):
    name = f"{file.parent.name}/sensor.yaml"
    values = {key: read_numbers(file, key) for key in keys}
    if read_key(file, "distortion_model") == "none":
        values.pop("distortion_coefficients", None)
    findings.report(f"{name}: no numbers of", [key for key, numbers in values.items() if not numbers])
    if values["T_BS"] and len(values["T_BS"]) != 16:
        findings.problems.append(f"{name}: T_BS must have 16 numbers")
    resolution = tuple(map(round, values["resolution"] or ()))
    if resolution and size and resolution != size:
        findings.problems.append(f"{name}: the calibration is for {in_px(resolution)}, the images have {in_px(size)}")


def read_list(findings, folder):
    """(stamps in ns, file names) of data.csv."""
    file = folder / "data.csv"
    stamps, files = [], []
    if not file.is_file():
        findings.problems.append(f"{folder.name}/data.csv is missing")
        return stamps, files
    for line, fields in rows_of(file, ","):
        if len(fields) < 2 or not fields[0].isdigit() or not fields[1] or stamps and int(fields[0]) <= stamps[-1]:
            findings.problems.append(f"{folder.name}/data.csv:{line}: is not 'stamp in ns, file' with a stamp after the previous one")
            break
        stamps.append(int(fields[0]))
        files.append(fields[1])
    return stamps, files


def check_truth(findings, root, stamps):
    places = [root / name / "data.csv" for name in ("state_groundtruth_estimate0", "vicon0", "mocap0")]
    file = next((place for place in places if place.is_file()), None)
    if not file:
        findings.notes.append("no ground truth (state_groundtruth_estimate0, vicon0 or mocap0)" +
                              ("; leica0 has positions only" if (root / "leica0").is_dir() else ""))
        return
    name, times = f"{file.parent.name}/data.csv", []
    for line, fields in rows_of(file, ","):
        values = numbers_of(fields[1:8])
        if not fields[0].isdigit() or not values or len(values) != 7 or times and int(fields[0]) <= times[-1]:
            findings.problems.append(f"{name}:{line}: is not 'stamp in ns, position, quaternion' with a stamp after the previous one")
            return
        times.append(int(fields[0]))
    findings.has_truth = bool(times)
    findings.facts.append(f"ground truth: {len(times)} poses, {duration([time * 1e-9 for time in times])}")
    outside = len(stamps) - bisect.bisect_right(stamps, times[-1]) + bisect.bisect_left(stamps, times[0]) if times else len(stamps)
    if stamps and outside == len(stamps):
        findings.problems.append(f"{name} covers none of the images: it is of another time")
    elif outside:
        findings.notes.append(f"{outside} of {len(stamps)} images are before or after the ground truth")


def read_key(file, key):
    """Value of a key at the begin of a line of a YAML file, or None."""
    if not file.is_file():
        return None
    found = re.search(rf"^{key}:[ \t]*([^#\n]*)", file.read_text(encoding="utf-8", errors="replace"), re.MULTILINE)
    return found[1].strip() if found else None


def read_numbers(file, key):
    """Numbers of a list in a YAML file, in brackets or one per line, also of a matrix with `data`; None if there are none."""
    text = file.read_text(encoding="utf-8", errors="replace")
    block = re.search(rf"^{key}:(.*?)(?=^\S|\Z)", text, re.MULTILINE | re.DOTALL)
    if not block:
        return None
    listed = re.search(r"\[([^\]]*)\]", block[1])
    items = listed[1].replace(",", " ").split() if listed else re.findall(r"^\s*-\s*(\S+)", block[1], re.MULTILINE)
    return numbers_of(items) or None
