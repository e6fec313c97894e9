# SPDX-License-Identifier: Apache-2.0
"""Writes the manual pages of an installed panvo, one per command, from what `panvo --help` and `panvo COMMAND --help` print."""
import argparse
import gzip
import os
import pathlib
import re
import subprocess

# "  --out DIR   folder for the results": a term, two spaces, its description; an indented line without one is an example.
ITEM = re.compile(r" {1,7}(\S.*?)(?: {2,}(\S.*))?$")
VERB = re.compile(r"  ([a-z][a-z-]*) {2,}(\S.*)")


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("`", "\\(ga").replace("'", "\\(aq")
    return "\\&" + text if text.startswith(".") else text


def body(lines):
    """roff of help text: paragraphs, lists of options, and headings, which are a word with a colon before a list."""
    roff, in_item, filling = [], False, False
    for line, following in zip(lines, [*lines[1:], ""]):
        item = ITEM.match(line)
        if not line.strip():
            in_item = filling = False
        elif item:
            roff += [".TP", f"\\fB{escaped(item[1])}\\fR", escaped(item[2] or "")] if item[2] else [".TP", escaped(line.strip()), "\\&"]
            in_item = True
        elif line[0] == " " and in_item:
            roff.append(escaped(line.strip()))
        elif re.fullmatch(r"\w+:", line) and following.startswith(" "):
            roff.append(f".SH {escaped(line[:-1].upper())}")
        else:
            roff += ([] if filling else [".PP"]) + [escaped(line.strip())]
            filling = True
    return [line for line in roff if line]


def page(name, version, summary, text, see_also):
    """A page in section 1; the lines of `text` up to the first empty one that begin with "usage:" are its synopsis."""
    lines = text.splitlines()
    begin = next((number for number, line in enumerate(lines) if line.startswith("usage:")), len(lines))
    end = next((number for number in range(begin, len(lines)) if not lines[number].strip()), len(lines))
    usage = [escaped(line.removeprefix("usage:").strip()) for line in lines[begin:end]]
    return "\n".join([
        f'.TH {name.upper()} 1 "" "panvo {version}" "panvo"', ".SH NAME", f"{escaped(name)} \\- {escaped(summary)}", ".SH SYNOPSIS", ".nf", *usage,
        ".fi", ".SH DESCRIPTION", *body(lines[end:]), ".SH SEE ALSO", ",\n".join(f"\\fB{escaped(other)}\\fR(1)" for other in see_also), ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("prefix", type=pathlib.Path, help="where panvo is installed; the pages go into share/man/man1 below it")
    parser.add_argument("programs", type=pathlib.Path, help="folder of programs that may be missing below the prefix")
    arguments = parser.parse_args()
    environment = dict(os.environ, PATH=f"{arguments.programs}:{os.environ['PATH']}",
                       LD_LIBRARY_PATH=":".join(map(str, [*arguments.prefix.glob("lib/*-linux-*"), arguments.prefix / "lib"])))

    def panvo(*words):
        return subprocess.run([arguments.prefix / "bin" / "panvo", *words], env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              check=True).stdout

    overview, version = panvo("--help"), panvo("--version").split()[1]
    verbs = dict(line.groups() for line in map(VERB.fullmatch, overview.splitlines()) if line)
    pages = {"panvo": page("panvo", version, overview.splitlines()[0].partition(": ")[2], overview.partition("\n")[2], [f"panvo-{verb}" for verb in verbs])}
    for verb, summary in verbs.items():
        pages[f"panvo-{verb}"] = page(f"panvo-{verb}", version, summary, panvo(verb, "--help"), ["panvo"])
    folder = arguments.prefix / "share" / "man" / "man1"
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in pages.items():
        (folder / f"{name}.1.gz").write_bytes(gzip.compress(text.encode(), mtime=0))


if __name__ == "__main__":
    main()
