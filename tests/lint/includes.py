# SPDX-License-Identifier: Apache-2.0
"""A source includes, directly or through other headers, one that declares each name of another package which it uses. Precompiled headers and sources
compiled together hide that one is missing, until a package is built by itself."""
import collections
import os
import pathlib
import re

import workspace

INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
NAMESPACE = re.compile(r"^namespace panvo::(\w+) \{", re.MULTILINE)
TYPE = re.compile(r"^(?:class|struct|enum class|using) ([A-Z]\w+)", re.MULTILINE)
FUNCTION = re.compile(r"^(?! |using|struct|class|enum|template|return)[\w:<>,&*\[\] ]+[ &*](\w+)\(", re.MULTILINE)
CONSTANT = re.compile(r"^inline constexpr [\w:<>,* ]+[ *](k[A-Z]\w*)", re.MULTILINE)
QUALIFIED = re.compile(r"\b(\w+)::(\w+)\b")


class Includes:
    def __init__(self, root):
        self.texts = {path: workspace.read(root, path) for path in workspace.source_files(root) if path.suffix in (".cpp", ".hpp")}
        self.public = {"/".join(path.parts[path.parts.index("include") + 1:]): path for path in self.texts if "include" in path.parts}

    def included(self, path):
        """All files that `path` includes, itself among them."""
        found, rest = {path}, [path]
        while rest:
            source = rest.pop()
            for name in INCLUDE.findall(self.texts[source]):
                target = self.public.get(name, pathlib.Path(os.path.normpath(source.parent / name)))
                if target in self.texts and target not in found:
                    found.add(target)
                    rest.append(target)
        return found

    def declarations(self):
        """(namespace, name) -> the public headers that declare it."""
        headers = collections.defaultdict(set)
        for path in self.public.values():
            text = workspace.without_comments(self.texts[path])
            for namespace in NAMESPACE.findall(text)[:1]:
                for name in TYPE.findall(text) + FUNCTION.findall(text) + CONSTANT.findall(text):
                    headers[namespace, name].add(path)
        return headers


def check(root):
    includes = Includes(pathlib.Path(root))
    declared = includes.declarations()
    complaints = []
    for path, text in sorted(includes.texts.items()):
        if not {"include", "src", "tools"} & set(path.parts):
            continue
        text = workspace.without_comments(text)
        used = sorted({name for name in QUALIFIED.findall(text) if name in declared and not re.search(rf"\b(?:class|struct) {name[1]};", text)})
        known = includes.included(path) if used else set()
        complaints += [f"{path}: {'::'.join(name)} is used; include {sorted(map(str, declared[name]))[0]}" for name in used if not declared[name] & known]
    return complaints


if __name__ == "__main__":
    workspace.run(check)
