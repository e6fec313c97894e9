# SPDX-License-Identifier: Apache-2.0
"""What a check found in one sequence."""
import dataclasses
import pathlib

import images

SHOWN = 3  # examples per kind of problem


@dataclasses.dataclass
class Findings:
    folder: pathlib.Path
    facts: list = dataclasses.field(default_factory=list)
    notes: list = dataclasses.field(default_factory=list)  # the player copes with these
    problems: list = dataclasses.field(default_factory=list)
    has_stereo: bool = False
    has_panorama: bool = False
    has_truth: bool = False

    def report(self, what, examples):
        """A problem with some examples, if there are any."""
        if examples:
            more = f" and {len(examples) - SHOWN} more" if len(examples) > SHOWN else ""
            self.problems.append(f"{what}: {', '.join(map(str, examples[:SHOWN]))}{more}")

    def check_images(self, folder, names):
        """Reports images that are missing or damaged. Returns the size of the first sound one in px, or None."""
        missing, damaged, size = [], [], None
        for name in names:
            file = folder / name
            if not file.is_file():
                missing.append(name)
                continue
            problem = images.problem_of(file)
            if problem:
                damaged.append(f"{name} {problem}")
            elif size is None:
                size = images.size_of(file)
        self.report(f"{self.shown(folder)}: missing images", missing)
        self.report(f"{self.shown(folder)}: damaged images", damaged)
        return size

    def shown(self, path):
        return path.relative_to(self.folder) if path.is_relative_to(self.folder) else path


def in_px(size):
    return f"{size[0]} x {size[1]} px" if size else "of unknown size"


def duration(stamps_s):
    """Duration and mean rate of increasing stamps, as text."""
    if len(stamps_s) < 2 or stamps_s[-1] <= stamps_s[0]:
        return "one instant"
    length = stamps_s[-1] - stamps_s[0]
    return f"{length:.1f} s, {(len(stamps_s) - 1) / length:.1f} Hz"


def numbers_of(fields):
    """The fields as numbers, or None if one is not a finite number."""
    try:
        values = [float(field) for field in fields]
    except ValueError:
        return None
    return values if all(abs(value) < float("inf") for value in values) else None


def rows_of(file, separator=None):
    """(line number, fields) of each line that is neither empty nor a comment."""
    with open(file, encoding="utf-8", errors="replace") as stream:
        for number, line in enumerate(stream, 1):
            line = line.strip()
            if line and not line.startswith("#"):
                yield number, [field.strip() for field in line.split(separator)]
