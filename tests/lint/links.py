# SPDX-License-Identifier: Apache-2.0
"""Links in Markdown files: a relative link leads to a file or folder of the workspace, its #anchor to a heading there."""
import itertools
import os
import pathlib
import re
import urllib.parse

import workspace

FENCED = re.compile(r"^(?P<fence>[ \t]*```).*?^(?P=fence)[ \t]*$", re.DOTALL | re.MULTILINE)
INLINE_CODE = re.compile(r"(?<!`)(?P<ticks>`+)(?!`)(?:(?!\n\n).)+?(?<!`)(?P=ticks)(?!`)", re.DOTALL)
# [text](target "title"), and a definition of its own line: [label]: target
LINK = re.compile(r"\]\((?P<inline>[^()\s]+)(?:\s+\"[^\"]*\")?\)|^ {0,3}\[[^\]]+\]:\s+(?P<defined>\S+)\s*$", re.MULTILINE)
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$", re.MULTILINE)


def blank(match):
    """Spaces instead of a match; line numbers are preserved."""
    return re.sub(r"[^\n]", " ", match[0])


def without_code(text):
    return INLINE_CODE.sub(blank, FENCED.sub(blank, text))


def links_of(text):
    """(line number, target) of each link, except those to other sites."""
    found = []
    for link in LINK.finditer(without_code(text)):
        target = link["inline"] or link["defined"]
        if not re.match(r"[a-z][a-z0-9+.-]*:", target):
            found.append((text.count("\n", 0, link.start()) + 1, target))
    return found


def anchors_of(text):
    """Anchors of the headings: lower case, without punctuation, a hyphen for each space; repeated ones are numbered."""
    anchors = set()
    for heading in HEADING.findall(FENCED.sub(blank, text)):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        anchor = re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")
        repeated = (f"{anchor}-{number}" for number in itertools.count(1))
        anchors.add(anchor if anchor not in anchors else next(numbered for numbered in repeated if numbered not in anchors))
    return anchors


def fault_of(root, page, target):
    """What is wrong with a link, or None."""
    path, _, anchor = urllib.parse.unquote(target).partition("#")
    if path.startswith("/"):
        return "must be relative"
    file = pathlib.PurePath(os.path.normpath(page.parent / path)) if path else page
    if file.parts[:1] == ("..",):
        return "leads out of the workspace"
    if not (root / file).exists():
        return "leads nowhere"
    if anchor and (file.suffix != ".md" or anchor not in anchors_of(workspace.read(root, file))):
        return f"{file} has no heading for #{anchor}"
    return None


def check(root):
    root = pathlib.Path(root)
    complaints = []
    for page in workspace.source_files(root):
        if page.suffix != ".md":
            continue
        for line, target in links_of(workspace.read(root, page)):
            if fault := fault_of(root, page, target):
                complaints.append(f"{page}:{line}: link to {target}: {fault}")
    return complaints


if __name__ == "__main__":
    workspace.run(check)
