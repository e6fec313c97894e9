# SPDX-License-Identifier: Apache-2.0
"""Summarises ctest's JUnit files: why tests were skipped, which ones failed and why, and on the last line the counts."""
import argparse
import collections
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

GTEST_SKIP = re.compile(r"^.*: Skipped\n(?P<reason>(?:.+\n?)*)", re.MULTILINE)

# GoogleTest, node, unittest, sanitizers; each with the lines after it that say more.
FAILURE = re.compile(r": Failure$|^ *not ok |^(ERROR|FAIL): |Error: |ERROR: \w+Sanitizer|runtime error: |WARNING: ThreadSan")
LINES_OF_FAILURE = 6


def failure_reason(case):
    """What a failed test said first of its failure, else last of all."""
    lines = [line.rstrip() for line in (case.findtext("system-out") or "").splitlines() if line.strip()]
    first = next((i for i, line in enumerate(lines) if FAILURE.search(line)), -LINES_OF_FAILURE)
    return lines[first:][:LINES_OF_FAILURE]


def skip_reason(case):
    """Why a test was skipped: GoogleTest's text, else the last output line, else ctest's message."""
    output = case.findtext("system-out") or ""
    found = GTEST_SKIP.search(output)
    if found:
        lines = [line for line in found["reason"].splitlines() if not line.startswith("[")]
        reason = " ".join(line.strip() for line in lines if line.strip())
        if reason:
            return reason
    said = [line.strip() for line in output.splitlines() if line.strip() and not line.startswith("[")]
    if said:
        return said[-1]
    skipped = case.find("skipped")
    return (skipped.get("message") if skipped is not None else "") or "no reason given"


def read(files):
    """(passed, failed, skipped): names of passed tests, reasons of failed ones by name, and names of skipped ones by reason."""
    passed, failed, skipped = [], {}, collections.defaultdict(list)
    for file in files:
        for case in ElementTree.parse(file).getroot().iter("testcase"):
            name, status = case.get("name"), case.get("status")
            if status == "fail" or case.find("failure") is not None or case.find("error") is not None:
                failed[name] = failure_reason(case)
            elif status == "run":
                passed.append(name)
            else:  # notrun, disabled
                skipped[skip_reason(case)].append(name)
    return passed, failed, skipped


def report(files, status):
    files = [file for file in files if file.is_file()]
    passed, failed, skipped = read(files)
    skipped_count = sum(map(len, skipped.values()))
    print()
    for reason, names in skipped.items():
        print(f"skipped {len(names)}: {reason}")
        for name in names[:3]:
            print(f"    {name}")
        if len(names) > 3:
            print(f"    and {len(names) - 3} more")
    for name, reason in failed.items():
        print(f"failed: {name}")
        for line in reason:
            print(f"    {line[:160]}")
    good = not failed and status == 0 and passed
    if not failed and status != 0:
        print(f"no test failed, but ctest exited with status {status}: see its output above")
    elif not failed and not passed:
        print("no test passed: nothing was tested")
    print(f"{len(passed)} passed, {len(failed)} failed, {skipped_count} skipped", flush=True)
    return 0 if good else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--status", type=int, default=0, help="ctest's exit status")
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    return report(arguments.files, arguments.status)


if __name__ == "__main__":
    sys.exit(main())
