# SPDX-License-Identifier: Apache-2.0
"""Checks a sequence of KITTI odometry: images, times.txt, calib.txt, poses."""
import re

import images
from findings import Findings, duration, in_px, numbers_of, rows_of

EYES = ((("image_0", "P0:"), ("image_1", "P1:")), (("image_2", "P2:"), ("image_3", "P3:")))  # grey, coloured
USUAL_RATE_HZ = 10


def check(folder):
    findings = Findings(folder)
    eyes = EYES[0] if any((folder / name).is_dir() for name, _ in EYES[0]) else EYES[1]
    numbers = check_pairs(findings, [name for name, _ in eyes])
    check_times(findings, numbers)
    check_calibration(findings, [projection for _, projection in eyes])
    check_poses(findings, numbers)
    return findings


def number_of(name):
    """The number at the end of an image's name, or None."""
    found = re.search(r"(\d+)\.\w+$", name)
    return int(found[1]) if found else None


def check_pairs(findings, names):
    """Checks the images of both folders; also for the layout of left and right folders. Returns the numbers that both have."""
    by_number = []
    for name in names:
        folder = findings.folder / name
        if not folder.is_dir():
            findings.problems.append(f"{name}/ is missing")
            return []
        files = images.images_in(folder)
        findings.report(f"{name}: names without a number", [file for file in files if number_of(file) is None])
        by_number.append({number_of(file): file for file in files if number_of(file) is not None})
        if not files:
            findings.problems.append(f"{name}/ has no images")
    left, right = by_number
    sizes = {findings.check_images(findings.folder / name, files.values()) for name, files in zip(names, by_number)} - {None}
    if len(sizes) > 1:
        findings.problems.append(f"the images differ in size: {' and '.join(sorted(map(in_px, sizes)))}")
    findings.report(f"images of {names[0]} without partner in {names[1]}", [left[number] for number in sorted(left.keys() - right.keys())])
    findings.report(f"images of {names[1]} without partner in {names[0]}", [right[number] for number in sorted(right.keys() - left.keys())])
    pairs = sorted(left.keys() & right.keys())
    findings.has_stereo = bool(pairs)
    findings.facts.append(f"stereo: {len(pairs)} pairs, {in_px(next(iter(sizes), None))}")
    return pairs


def check_times(findings, numbers):
    file = findings.folder / "times.txt"
    if not file.is_file():
        findings.notes.append(f"no times.txt: {USUAL_RATE_HZ} Hz is assumed (--set dataset_player.rate_hz=HZ)")
        return
    times = []
    for line, fields in rows_of(file):
        value = numbers_of(fields[:1])
        if not value or times and value[0] <= times[-1]:
            findings.problems.append(f"times.txt:{line}: '{fields[0]}' is not a time in seconds after the previous one")
            return
        times.append(value[0])
    if numbers and numbers[-1] >= len(times):
        findings.problems.append(f"times.txt has {len(times)} times, but the last image is number {numbers[-1]} (counted from 0)")
    elif numbers:
        findings.facts.append(f"times: {duration([times[number] for number in numbers])}")


def check_calibration(findings, projections):
    file = findings.folder / "calib.txt"
    if not file.is_file():
        findings.problems.append("calib.txt is missing: it is in data_odometry_calib.zip")
        return
    found = {fields[0]: numbers_of(fields[1:]) for _, fields in rows_of(file)}
    matrices = [found.get(name) for name in projections]
    for name, matrix in zip(projections, matrices):
        if matrix is None or len(matrix) != 12 or matrix[0] <= 0:
            findings.problems.append(f"calib.txt: no line '{name}' with 12 numbers and a focal length")
            return
    left, right = matrices
    baseline_m = left[3] / left[0] - right[3] / right[0]
    if baseline_m <= 0:
        findings.problems.append(f"calib.txt: the baseline is {baseline_m:.3f} m; left and right may be exchanged")
    else:
        findings.facts.append(f"calibration: focal length {left[0]:.1f} px, baseline {baseline_m:.3f} m")


def check_poses(findings, numbers):
    folder = findings.folder.resolve()  # as the player does
    beside = f"poses/{folder.name}.txt"
    places = (folder / "poses.txt", folder.parent / beside, folder.parent.parent / beside)
    file = next((place for place in places if place.is_file()), None)
    if not file:
        findings.notes.append("no ground truth: neither poses.txt nor poses/NN.txt (KITTI publishes that of sequences 00 to 10)")
        return
    count = 0
    for line, fields in rows_of(file):
        values = numbers_of(fields)
        if not values or len(values) != 12:
            findings.problems.append(f"{file.name}:{line}: is not a pose of 12 numbers")
            return
        count += 1
    findings.has_truth = count > 0
    findings.facts.append(f"ground truth: {count} poses")
    if numbers and count <= numbers[-1]:
        findings.notes.append(f"{sum(number >= count for number in numbers)} pairs have no ground truth")
