# SPDX-License-Identifier: Apache-2.0
"""Sources of one library, plugin or program are compiled together, so an internal function or constant must not have the name of another source's, or
of a function of the package's headers: a call could silently bind to that one."""
import collections
import pathlib
import re

import workspace

TARGET = re.compile(r"panvo_add_(?:library|component|executable|python_module)\(\s*(\S+)([^)]*)\)")
INTERNAL = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.DOTALL | re.MULTILINE)
GLOB = re.compile(r"file\(GLOB (\w+) CONFIGURE_DEPENDS ([^)]*)\)")
# A definition or declaration that starts a line: return type, name, parameters.
FUNCTION = re.compile(r"^(?:\[\[\w+\]\] )?(?! |using|struct|class|enum|template|return)[\w:<>,&* ]+[ &*](\w+)\([^;]*?\)[^;=]*\{", re.MULTILINE)
DECLARED = re.compile(r"^(?:\[\[\w+\]\] )?(?! |using|struct|class|enum|template|return)[\w:<>,&* ]+[ &*](\w+)\(", re.MULTILINE)


CONSTANT = re.compile(r"^(?:constexpr|const) [\w:<>,* ]+[ *](k[A-Z]\w*)(?:\[\w*\])*(?: =|\{)", re.MULTILINE)


def internal_names(text):
    blocks = [workspace.without_comments(block) for block in INTERNAL.findall(text)]
    return {name for block in blocks for name in FUNCTION.findall(block) + CONSTANT.findall(block)}


def targets(root, lists):
    """Pairs of a target and its sources."""
    text = re.sub(r"#[^\n]*", "", workspace.read(root, lists))
    for variable, patterns in GLOB.findall(text):
        text = text.replace(f"${{{variable}}}", patterns)
    for target, arguments in TARGET.findall(text):
        patterns = re.findall(r"\S+\.cpp", arguments)
        yield target, sorted({file.relative_to(root) for pattern in patterns for file in (root / lists.parent).glob(pattern)})


def check(root):
    root = pathlib.Path(root)
    complaints = []
    for lists in (path for path in workspace.source_files(root) if path.name == "CMakeLists.txt"):
        headers = [path.relative_to(root) for folder in ("include", "src", "tools") for path in (root / lists.parent / folder).rglob("*.hpp")]
        declared = {name: path for path in headers for name in DECLARED.findall(workspace.without_comments(workspace.read(root, path)))}
        for target, sources in targets(root, lists):
            users = collections.defaultdict(list, {name: [path] for name, path in declared.items()})
            for source in sources:
                for name in internal_names(workspace.read(root, source)):
                    users[name].append(source)
            complaints += [f"{users_of[1]}: the internal name {name} is that of one in {users_of[0]}, which is compiled together with it "
                           f"in {target}; rename one, or share it" for name, users_of in sorted(users.items()) if len(users_of) > 1]
    return complaints


if __name__ == "__main__":
    workspace.run(check)
