#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a command for a long time and checks its memory, file descriptors and threads: `panvo bench endurance`.

Writes the samples to samples.csv, a plot to samples.png (if gnuplot is installed) and the verdicts to standard output.
Exit status: 0 all conditions hold, 1 one does not, 2 wrong usage.
"""

from __future__ import annotations

import argparse
import csv
import dataclasses
import os
import pathlib
import shutil
import signal
import statistics
import subprocess
import sys
import time

# The first part of a run fills caches and queues and is ignored.
WARM_UP_SHARE = 0.2
# Length of the two compared parts: after the warm-up, and at the end.
COMPARED_SHARE = 0.2
STOP_LIMIT_S = 30.0


@dataclasses.dataclass
class Sample:
    """State of a process from /proc."""

    elapsed_s: float
    memory_mb: float
    descriptors: int
    threads: int
    cpu_s: float


def sample(pid: int, begin: float) -> Sample | None:
    """None if the process has ended."""
    try:
        status = pathlib.Path(f"/proc/{pid}/status").read_text(encoding="ascii", errors="replace")
        stat = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="ascii", errors="replace")
        descriptors = len(os.listdir(f"/proc/{pid}/fd"))
    except OSError:
        return None
    values = dict(line.split(":", 1) for line in status.splitlines() if ":" in line)
    if "VmRSS" not in values:  # a zombie
        return None
    ticks = sum(int(field) for field in stat.rsplit(")", 1)[1].split()[11:13])
    return Sample(
        time.monotonic() - begin,
        int(values["VmRSS"].split()[0]) / 1024.0,
        descriptors,
        int(values["Threads"]),
        ticks / os.sysconf("SC_CLK_TCK"),
    )


def watch(command: list[str], period_s: float, log: pathlib.Path) -> tuple[int, list[Sample]]:
    """Runs the command to its end. Returns its exit status and the samples."""
    samples: list[Sample] = []
    with open(log, "wb") as output:
        begin = time.monotonic()
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            next_report_s = 60.0
            while process.poll() is None:
                now = sample(process.pid, begin)
                if now:
                    samples.append(now)
                    if now.elapsed_s >= next_report_s:
                        next_report_s += 60.0
                        print(f"{now.elapsed_s / 60:.0f} min: {now.memory_mb:.1f} MB, {now.descriptors} descriptors, "
                              f"{now.threads} threads, {now.cpu_s / now.elapsed_s:.2f} cores", flush=True)
                try:
                    process.wait(period_s)
                except subprocess.TimeoutExpired:
                    pass
        except KeyboardInterrupt:
            os.killpg(process.pid, signal.SIGINT)
            process.wait(STOP_LIMIT_S)
    return process.returncode, samples


@dataclasses.dataclass
class Verdict:
    """A condition and its result."""

    name: str
    holds: bool
    figure: str


def judge(status: int, samples: list[Sample], tolerance: float) -> list[Verdict]:
    """Compares the part after the warm-up with the last part."""
    verdicts = [Verdict("ends well", status == 0, f"exit status {status}")]
    length_s = samples[-1].elapsed_s if samples else 0.0
    after = [s for s in samples if s.elapsed_s >= WARM_UP_SHARE * length_s]
    early = [s for s in after if s.elapsed_s <= (WARM_UP_SHARE + COMPARED_SHARE) * length_s]
    late = [s for s in samples if s.elapsed_s >= (1.0 - COMPARED_SHARE) * length_s]
    if not early or not late:
        return verdicts + [Verdict("is long enough to judge", False, f"{len(samples)} samples")]
    before_mb, after_mb = (statistics.median(s.memory_mb for s in part) for part in (early, late))
    growth = after_mb / before_mb - 1.0
    verdicts.append(Verdict("memory is flat", abs(growth) <= tolerance,
                            f"{before_mb:.1f} -> {after_mb:.1f} MB, {100 * growth:+.1f} % (at most {100 * tolerance:.0f} %)"))
    for name, values in (("descriptors", [s.descriptors for s in after]), ("threads", [s.threads for s in after])):
        verdicts.append(Verdict(f"{name} are constant", statistics.median(values[: len(values) // 2]) == statistics.median(values[len(values) // 2 :]),
                                f"{min(values)} to {max(values)}"))
    return verdicts


def write(samples: list[Sample], out: pathlib.Path) -> None:
    """Writes samples.csv and, if gnuplot is installed, samples.png."""
    table = out / "samples.csv"
    with open(table, "w", newline="", encoding="ascii") as file:
        writer = csv.writer(file)
        writer.writerow([field.name for field in dataclasses.fields(Sample)])
        writer.writerows(dataclasses.astuple(s) for s in samples)
    if not shutil.which("gnuplot"):
        return
    script = f"""
set terminal pngcairo size 1000,500; set output '{out / "samples.png"}'; set datafile separator ','
set xlabel 'time, min'; set ylabel 'resident memory, MB'; set yrange [0:*]
set y2label 'descriptors, threads'; set y2range [0:*]; set y2tics; set key bottom right
plot '{table}' every ::1 using ($1/60):2 with lines lw 2 title 'memory', \\
  '' every ::1 using ($1/60):3 axes x1y2 with lines title 'descriptors', '' every ::1 using ($1/60):4 axes x1y2 with lines title 'threads'
"""
    subprocess.run(["gnuplot"], input=script, text=True, check=False)


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for samples.csv, samples.png and output.log")
    parser.add_argument("--period", type=float, default=5.0, help="sampling period, s")
    parser.add_argument("--tolerance", type=float, default=0.05, help="permitted relative change of memory between the two parts")
    parser.add_argument("command", nargs=argparse.REMAINDER, help="-- COMMAND [ARGUMENT...]")
    options = parser.parse_args(arguments)
    command = options.command[1:] if options.command[:1] == ["--"] else options.command
    if not command:
        parser.error("no command given; write it after --")
    options.out.mkdir(parents=True, exist_ok=True)
    status, samples = watch(command, options.period, options.out / "output.log")
    write(samples, options.out)
    verdicts = judge(status, samples, options.tolerance)
    for verdict in verdicts:
        print(f"{'holds' if verdict.holds else 'FAILS'}  {verdict.name}: {verdict.figure}")
    return 0 if all(verdict.holds for verdict in verdicts) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
