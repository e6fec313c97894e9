# SPDX-License-Identifier: Apache-2.0
"""panvo bench accuracy: errors of the whole system over several drives with ground truth, with 95 % intervals, as one Markdown page.

Each drive is replayed through each system of its group; panvo_evaluate_journey gives the errors. Drives of a group differ in their seed only,
so that the interval tells how much the figures of another seed may differ.
"""
import argparse
import dataclasses
import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys

from report import Failed, add_page_arguments, figure, inside, machine, run, table, write_page

SYSTEMS = pathlib.Path(__file__).resolve().parent.parent.parent / "config" / "systems"
# Quantiles of Student's distribution for a two-sided interval of 95 %, by degrees of freedom; more than ten: that of ten, a little too wide.
STUDENT = (0.0, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228)


@dataclasses.dataclass(frozen=True)
class Variant:
    """A system that plays the drives of a group, and the trajectories that are rows of the table."""
    text: str
    system: pathlib.Path
    arguments: tuple = ()
    trajectories: tuple = ("enhanced",)


VARIANTS = {
    "stereo": (Variant("stereo + panorama", SYSTEMS / "enhanced_vo.yaml", trajectories=("binocular", "enhanced")),
               Variant("+ gyroscope, wheels", pathlib.Path(__file__).resolve().parent / "modelled_sensors.yaml")),
    "panorama": (Variant("modelled odometry + panorama", SYSTEMS / "modelled_odometry.yaml", trajectories=("binocular", "enhanced")),
                 Variant("+ gyroscope, wheels", SYSTEMS / "modelled_odometry.yaml", ("sensors:=true",)),
                 Variant("+ satellites", SYSTEMS / "modelled_odometry.yaml", ("gnss:=true",))),
}


@dataclasses.dataclass(frozen=True)
class Drive:
    """Errors of one replay."""
    journey: dict    # "run" of journey.json
    seconds: float   # CPU time of the replay
    memory_mb: float


def replay(programs, variant, drive, out):
    """Runs a system on a drive and evaluates it."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    memory_mb = run_watched([programs / "panvo_run", variant.system, *variant.arguments, "--dataset", drive, "--replay", "--seed", "1", "--out", out])
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    run([programs / "panvo_evaluate_journey", out, "--recording", drive, "--out", out])
    journey = json.loads((out / "journey.json").read_text(encoding="utf-8"))["run"]
    return Drive(journey, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, memory_mb)


def run_watched(command):
    """Runs a program; returns its largest resident memory, MB."""
    with subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        errors = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        lines = errors.strip().splitlines()
        raise Failed(f"{pathlib.Path(command[0]).name}: {lines[-1] if lines else f'exit status {process.returncode}'}")
    return usage.ru_maxrss / 1024.0


def interval(values):
    """Mean and half the width of its 95 % interval; None for the width if there are fewer than two values."""
    if not values:
        return None, None
    width = None
    if len(values) > 1:
        width = STUDENT[min(len(values) - 1, len(STUDENT) - 1)] * statistics.stdev(values) / len(values) ** 0.5
    return statistics.fmean(values), width


def summary(values, digits):
    """Mean, interval and worst: "0.21 +- 0.08 (0.31)"."""
    known = [value for value in values if value is not None]
    mean, width = interval(known)
    if mean is None:
        return "-"
    text = figure(mean, digits)
    return text if width is None else f"{text} ± {figure(width, digits)} ({figure(max(known), digits)})"


def revisits(drives, key):
    """Magnitudes of an error just after each corrected revisit."""
    rows = [row for drive in drives for row in drive.journey["revisits"]["rows"] if row["result"] == "corrected"]
    return [abs(row[key]) for row in rows if row[key] is not None]


COLUMNS = ("drives", "system", "n", "path, m", "horizontal error, m", "% of the way", "heading, deg", "after a revisit, m",
           "beyond the landmark's, m", "heading after, deg", "corrections, wrong", "NEES (2)", "CPU, % of a core", "memory, MB")


def row(group, text, trajectory, drives):
    paths = [drive.journey["paths"] for drive in drives]
    own = [path[trajectory] for path in paths]
    cells = [group, text, str(len(drives)), figure(statistics.fmean(path["travelled_m"] for path in paths), 0),
             summary([path["flat_rms_m"] for path in own], 2), summary([path["flat_percent_of_way"] for path in own], 3),
             summary([path["heading_rms_deg"] for path in own], 2)]
    if trajectory != "enhanced":
        return cells + ["-"] * (len(COLUMNS) - len(cells))
    return cells + [summary(revisits(drives, "after_m"), 2), summary(revisits(drives, "beyond_landmark_m"), 2),
                    summary(revisits(drives, "after_heading_deg"), 2),
                    ", ".join(str(sum(drive.journey["revisits"][key] for drive in drives)) for key in ("applied", "wrong")),
                    summary([inside(path, "nees", "plane", "mean") for path in paths], 1),
                    summary([100.0 * drive.seconds / drive.journey["paths"]["duration_s"] for drive in drives], 0),
                    figure(max(drive.memory_mb for drive in drives), 0)]


def measure(programs, groups, work):
    """Rows of the table, and what is missing."""
    rows, missing = [], []
    for kind, name, *paths in groups:
        for variant in VARIANTS[kind]:
            drives = []
            for path in map(pathlib.Path, paths):
                print(f"{name}: {path.name}, {variant.text}", file=sys.stderr)
                try:
                    drives.append(replay(programs, variant, path, work / f"{path.name}-{variant.system.stem}{'-'.join(('', *variant.arguments))}"))
                except Failed as error:
                    missing.append(f"{name}, {path.name}, {variant.text}: {error}")
            if not drives:
                continue
            for trajectory in variant.trajectories:
                text = variant.text if trajectory == "enhanced" else variant.text.split(" + ")[0]
                rows.append(row(name, text, trajectory, drives))
    return rows, missing


def page(version, rows, missing, where):
    lines = ["# Accuracy of this version", "", f"Written by `panvo bench accuracy`: panvo {version}, {where}.", "",
             "Causal, from the start of the drive, without alignment: mean over the drives ± half of its 95 % interval (worst). Errors are horizontal, RMS",
             "over a drive. \"After a revisit\" is the error just after each correction at a place that was passed before, and what of it is not the error of",
             "that place in the map; a correction is wrong if it adds more than a metre. NEES: horizontal position, 2 is expected,",
             "smaller means cautious. CPU: of a replay, decoding of images included.", ""]
    lines += table(COLUMNS, rows) if rows else ["Nothing was measured."]
    if missing:
        lines += ["", "## Not measured", "", *(f"- {text}" for text in missing)]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(prog="panvo bench accuracy", description=__doc__.splitlines()[0])
    parser.add_argument("--drives", nargs="+", action="append", required=True, metavar=("KIND", "NAME"),
                        help=f"kind ({', '.join(VARIANTS)}), name of the group, and folders of its drives")
    add_page_arguments(parser)
    arguments = parser.parse_args()
    for group in arguments.drives:
        if len(group) < 3 or group[0] not in VARIANTS:
            parser.error(f"--drives {' '.join(group)}: needs a kind ({', '.join(VARIANTS)}), a name and at least one folder")
    arguments.work.mkdir(parents=True, exist_ok=True)
    rows, missing = measure(arguments.programs, arguments.drives, arguments.work)
    text = page(arguments.version_text, rows, missing, machine())
    print(text)
    write_page(text, arguments.out)
    return 0 if rows else 1


if __name__ == "__main__":
    sys.exit(main())
