# SPDX-License-Identifier: Apache-2.0
"""panvo bench report: measures this build on recordings and with the benchmarks, and writes the figures as one Markdown page.

Each table names its command. Nothing in the page is typed by hand; a recording or benchmark that is missing is listed as such.
"""
import argparse
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys

# Recordings with ground truth, the system that plays them, and the trajectories that it writes.
RECORDINGS = (("kitti_03", "stereo", ("binocular",)), ("campus_clip", "enhanced_vo", ("binocular", "enhanced")),
              ("campus_journey", "modelled_odometry", ("binocular", "enhanced")))
ODOMETRY_STAGES = ("stereo/left/image_rect, stereo/right/image_rect", "motion")  # together: the CPU time of one stereo pair
BENCHMARKS = ("odometry", "compass", "places", "landmark_library", "stitching", "hand_over", "transport", "whole")
QUICK_BENCHMARKS = ("odometry", "compass", "places")


class Failed(Exception):
    """A program did not give its figures."""


def run(command, **options):
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    except OSError as error:
        raise Failed(f"{pathlib.Path(command[0]).name}: {error.strerror}") from error
    if done.returncode != 0:
        lines = (done.stderr or done.stdout).strip().splitlines()
        raise Failed(f"{pathlib.Path(command[0]).name}: {lines[-1] if lines else f'exit status {done.returncode}'}")
    return done.stdout


def figure(value, digits):
    return "-" if value is None else f"{value:.{digits}f}"


def inside(values, *keys):
    """values[a][b]..., or None."""
    for key in keys:
        if not isinstance(values, dict) or values.get(key) is None:
            return None
        values = values[key]
    return values


def cpu_per_pair_ms(timing):
    """Mean CPU time of the stereo odometry for one pair, ms; None if it did not run."""
    stages = {row["stage"]: row["cpu_ms"]["mean"] for row in timing or () if row["component"] == "binocular_odometry"}
    found = [stages[stage] for stage in ODOMETRY_STAGES if stage in stages]
    return sum(found) if len(found) == len(ODOMETRY_STAGES) else None


def accuracy_row(recording, system, trajectory, estimate):
    is_stereo = trajectory == "binocular" and system != "modelled_odometry"
    return [recording, system, trajectory, str(estimate["poses"]), figure(estimate.get("path_length_m"), 0),
            figure(inside(estimate, "ate_start_m", "rmse"), 3), figure(inside(estimate, "ate_se3_m", "rmse"), 3),
            figure(inside(estimate, "segments", "translation_percent"), 3), figure(estimate.get("end_error_percent"), 3),
            figure(inside(estimate, "nees", "motion", "mean"), 1),
            figure(cpu_per_pair_ms(estimate.get("timing")) if is_stereo else None, 1)]


ACCURACY_COLUMNS = ("recording", "system", "trajectory", "poses", "path, m", "ATE from the start, m", "ATE after SE3, m", "segments, %",
                    "error at the end, %", "NEES of the motion (6)", "CPU per pair, ms")


def table(columns, rows):
    lines = ["| " + " | ".join(columns) + " |", "|" + " --- |" * len(columns)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def measure_accuracy(programs, systems, data, work):
    """Rows of the table, and what is missing."""
    rows, missing = [], []
    for recording, system, trajectories in RECORDINGS:
        source, out = data / recording, work / recording
        if not source.is_dir():
            missing.append(f"{recording}: not in {data.name}/")
            continue
        try:
            run([programs / "panvo_run", systems / f"{system}.yaml", "--dataset", source, "--replay", "--seed", "1", "--out", out])
            for trajectory in trajectories:
                text = run([programs / "panvo_evaluate", out / f"odometry_{trajectory}.tum", source, "--json", "--no-plot", "--out", work])
                rows.append(accuracy_row(recording, system, trajectory, json.loads(text)["estimates"][0]))
        except Failed as error:
            missing.append(f"{recording}: {error}")
    return rows, missing


def benchmark_row(entry):
    counters = [f"{name} {value:.4g}" for name, value in sorted(entry.items())
                if isinstance(value, float) and name not in ("real_time", "cpu_time")]
    return [entry["name"].removesuffix("/manual_time").removesuffix("/real_time"), f"{entry['real_time']:.4g}", f"{entry['cpu_time']:.4g}",
            entry["time_unit"], ", ".join(counters)]


BENCHMARK_COLUMNS = ("benchmark", "time", "CPU time", "unit", "counters")


def measure_benchmarks(programs, data, names):
    """(name, rows) of each benchmark program, and what is missing."""
    tables, missing = [], []
    environment = dict(os.environ, PANVO_DATA=str(data))
    for name in names:
        program = programs / f"panvo_{name}_benchmark"
        if not program.exists():
            missing.append(f"{name}: not built")
            continue
        try:
            entries = json.loads(run([program, "--benchmark_format=json"], env=environment))["benchmarks"]
        except (Failed, ValueError, KeyError) as error:
            missing.append(f"{name}: {error}")
            continue
        missing += [f"{entry['name']}: {entry['error_message']}" for entry in entries if entry.get("error_occurred")]
        tables.append((name, [benchmark_row(entry) for entry in entries if not entry.get("error_occurred")]))
    return tables, missing


def machine():
    model = platform.processor() or platform.machine()
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
                break
    except OSError:
        pass
    return f"{model}, {os.cpu_count()} cores"


def add_page_arguments(parser):
    """What every program of a page is told."""
    for name, text in (("out", "the page to write"), ("work", "folder for the runs"), ("programs", argparse.SUPPRESS)):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True, help=text)
    parser.add_argument("--version-text", required=True, help=argparse.SUPPRESS)


def write_page(text, out):
    out.write_text(text, encoding="utf-8")
    print(f"written: {out}", file=sys.stderr)


def page(version, accuracy, benchmarks, where):
    rows, missing = accuracy
    tables, not_run = benchmarks
    lines = ["# Measurements of this version", "",
             f"Written by `panvo bench report` on {datetime.date.today().isoformat()}: panvo {version}, {where}. Times are those of this machine.",
             "Recordings: the folder that `PANVO_DATA` names; `panvo data` lists public ones.", "",
             "## Accuracy", "",
             "`panvo run SYSTEM --dataset RECORDING --replay --seed 1 --out DIR`, then `panvo evaluate DIR RECORDING`. In `modelled_odometry` the",
             "trajectory `binocular` is the ground truth with a simulated drift.", ""]
    lines += table(ACCURACY_COLUMNS, rows) if rows else ["No recording was found."]
    for name, entries in tables:
        lines += ["", f"## Times: {name}", "", f"`panvo bench {name}`", "", *table(BENCHMARK_COLUMNS, entries)]
    if missing or not_run:
        lines += ["", "## Not measured", "", *(f"- {text}" for text in missing + not_run)]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(prog="panvo bench report", description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help=f"only the benchmarks {', '.join(QUICK_BENCHMARKS)}")
    add_page_arguments(parser)
    for name in ("systems", "data"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    print("accuracy on recordings", file=sys.stderr)
    accuracy = measure_accuracy(arguments.programs, arguments.systems, arguments.data, arguments.work)
    print("benchmarks", file=sys.stderr)
    benchmarks = measure_benchmarks(arguments.programs, arguments.data, QUICK_BENCHMARKS if arguments.quick else BENCHMARKS)
    write_page(page(arguments.version_text, accuracy, benchmarks, machine()), arguments.out)
    return 1 if not accuracy[0] and not benchmarks[0] else 0


if __name__ == "__main__":
    sys.exit(main())
