# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy on many sources at once.

clang-tidy spends most of its time in the headers of Eigen, OpenCV and the standard library, again for every source. Therefore
sources with the same flags are joined into few translation units, as in unity builds. Sources that define the same name at file
scope go into different units; if a clash remains, the unit is split into halves. The checks are configured in .clang-tidy only.
"""
import argparse
import concurrent.futures
import json
import pathlib
import re
import shlex
import subprocess
import sys
import threading

WITHOUT_MEANING = re.compile(r"-fno-gnu-unique|-f(?:PIC|PIE)|-O\d|-g|-W.*|-D\w+_EXPORTS")  # irrelevant for the check, or unknown to clang
# At column 0: a type, or a function or constant whose name is not qualified (Class::member clashes with nothing).
FILE_SCOPE_TYPE = re.compile(r"^(?:struct|class|enum(?: class)?|union)\s+(\w+)", re.MULTILINE)
FILE_SCOPE_NAME = re.compile(r"^(?!namespace|using|template|class|struct|enum|#|//|TEST|return|extern)\w[\w:<>,&* ]*?[ &*](\w+)\s*[(={\[]", re.MULTILINE)
LARGEST_UNIT = 30  # sources; larger units would be distributed badly over the jobs


def commands(build):
    """source -> its compile flags for clang, without compiler, -c and output."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        words = shlex.split(entry["command"])
        while words and not re.search(r"(^|/)(c\+\+|g\+\+|clang\+\+)[\w.-]*$", words[0]):
            words.pop(0)  # ccache
        flags, rest = [], iter(words[1:])
        for word in rest:
            if word == "-o":
                next(rest)
            elif word == "-isystem":
                flags.append(word + next(rest))
            elif word != "-c" and not WITHOUT_MEANING.fullmatch(word) and word != entry["file"]:
                flags.append(word)
        found[pathlib.Path(entry["file"])] = tuple(flags)
    return found


def file_scope_names(text):
    """Names that a source defines at column 0, which could clash within a unit."""
    return set(FILE_SCOPE_TYPE.findall(text)) | set(FILE_SCOPE_NAME.findall(text))


def is_search_path(flag):
    return flag.startswith(("-I", "-isystem"))


def units(sources, flags_of):
    """Groups sources into translation units with equal flags (except search paths) and without duplicate names."""
    made = []  # [flags, names, sources]
    for source in sources:
        names = file_scope_names(source.read_text(encoding="utf-8"))
        flags = {flag for flag in flags_of[source] if not is_search_path(flag)}
        for unit in made:
            if unit[0] == flags and not unit[1] & names and len(unit[2]) < LARGEST_UNIT:
                unit[1] |= names
                unit[2].append(source)
                break
        else:
            made.append([flags, set(names), [source]])
    return [unit[2] for unit in made]


def run_unit(sources, flags_of, folder, checks, root):
    """Complaints of clang-tidy on a unit: {(file, line, column, text)}."""
    flags = list(dict.fromkeys(flag for source in sources for flag in flags_of[source]))
    file = sources[0]
    if len(sources) > 1:
        file = folder / f"{sources[0].stem}_and_{len(sources) - 1}_{threading.get_ident()}.cpp"
        file.write_text("".join(f'#include "{source}"\n' for source in sources), encoding="utf-8")
    command = ["clang-tidy", "--quiet", f"--config-file={root / '.clang-tidy'}", *checks, str(file), "--", *flags]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)
    found = set(re.findall(r"^(/[^:\n]+):(\d+):(\d+): (?:error|warning): ([^\n]+)", done.stdout, re.MULTILINE))
    broken = [complaint for complaint in found if "clang-diagnostic-error" in complaint[3]]
    if len(sources) > 1 and (broken or done.returncode != 0 and not found):
        half = len(sources) // 2
        return run_unit(sources[:half], flags_of, folder, checks, root) | run_unit(sources[half:], flags_of, folder, checks, root)
    if done.returncode != 0 and not found:
        return {(str(file), "1", "1", f"clang-tidy failed: {done.stdout.strip()[-500:]}")}
    return found


def sources_of(files, known):
    """The compiled files; for a header, a source that includes it (matched by its last two path components)."""
    wanted = set()
    for file in files:
        if file in known:
            wanted.add(file)
        elif file.suffix == ".hpp":
            ending = "/".join(file.parts[-2:])
            including = [source for source in known if ending in source.read_text(encoding="utf-8")]
            wanted.update(including[:1])
    return sorted(wanted)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="folder with compile_commands.json")
    parser.add_argument("--naming", action="store_true", help="only the naming rules")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("files", type=pathlib.Path, nargs="+")
    arguments = parser.parse_args()

    root = pathlib.Path(__file__).resolve().parents[2]
    flags_of = commands(arguments.build)
    # If all files are given, headers are covered by the sources that include them.
    everything = len(arguments.files) > len(flags_of)
    files = [file.resolve() for file in arguments.files]
    sources = sorted(set(files) & set(flags_of)) if everything else sources_of(files, flags_of)
    if not sources:
        sys.exit("none of these files is compiled or included by a compiled file")
    folder = arguments.build / "lint"
    folder.mkdir(exist_ok=True)
    checks = ["--checks=-*,readability-identifier-naming"] if arguments.naming else []
    complaints = set()
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        pending = [pool.submit(run_unit, unit, flags_of, folder, checks, root) for unit in units(sources, flags_of)]
        for number, done in enumerate(concurrent.futures.as_completed(pending), 1):
            complaints |= done.result()
            print(f"  {number}/{len(pending)} units of {len(sources)} sources", file=sys.stderr, flush=True)
    for file, line, column, text in sorted(complaints, key=lambda c: (c[0], int(c[1]), int(c[2]), c[3])):
        shown = pathlib.Path(file)
        shown = shown.relative_to(root) if shown.is_relative_to(root) else shown
        print(f"{shown}:{line}:{column}: {text}", file=sys.stderr)
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
