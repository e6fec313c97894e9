# SPDX-License-Identifier: Apache-2.0
"""Fast text-based check of the naming rules, on every test run.

`panvo lint --naming` checks all names with clang-tidy and .clang-tidy, which takes minutes; this takes a second.
"""
import re

import workspace

# A constant may carry its unit: kMargin_px.
SNAKE, PASCAL, CONSTANT, MACRO = (re.compile(pattern) for pattern in (
    r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*", r"[A-Z][A-Za-z0-9]*", r"k[A-Z][A-Za-z0-9]*(?:_[a-z0-9]+)?", r"[A-Z][A-Z0-9_]*"))
TYPE = re.compile(r"^\s*(?:template\s*<.*>\s*)?(?:class|struct|enum(?:\s+class|\s+struct)?|union)\s+(?:\[\[\w+\]\]\s*)?(\w+)\s*(?:final\s*)?(?::[^:].*)?\{")
CONSTEXPR = re.compile(r"\b(?:static\s+|inline\s+)*constexpr\s+(?:const\s+)?[\w:<>,&*\s]*?[\s&*](\w+)(?:\[[^\]]*\])?\s*(?:=|\{)")
DEFINE = re.compile(r"^\s*#\s*define\s+(\w+)")
FUNCTION = re.compile(r"^(?!return|using|namespace|class|struct|enum|template|extern|#|else|case|typedef)[\w:<>,&*\s]+?[\s&*](?:\w+::)*(\w+)\(")
MEMBER = re.compile(r"^\s+(?!return|using|friend|static|typedef|struct|class|enum|union|template|case|public|private|protected|delete|throw|goto)"
                    r"(?:mutable\s+|const\s+)*[\w:]+(?:<[^;()]*>)?(?:::\w+)?[\s&*]+(\w+)\s*(?:=[^=;][^;]*|\{[^;]*\})?;")
ACCESS = re.compile(r"^(\s*)(public|protected|private):")


def file_names(root):
    for path in workspace.cpp_files(root):
        if not SNAKE.fullmatch(path.stem):
            yield f"{path}:1: files are snake_case"


def check_text(path, text):
    code = workspace.without_comments(text)
    private_from, complaints = None, []
    for number, line in enumerate(code.splitlines(), 1):
        def expect(match, pattern, what):
            if match and not pattern.fullmatch(match[1]):
                complaints.append(f"{path}:{number}: {match[1]}: {what}")

        expect(TYPE.match(line), PASCAL, "types are PascalCase")
        expect(DEFINE.match(line), MACRO, "macros are UPPER_CASE")
        if "operator" not in line and "(" not in line.split("constexpr")[-1].split("=")[0].split("{")[0]:
            expect(CONSTEXPR.search(line), CONSTANT, "constants are kName")
        if line[:1].isalpha() and "operator" not in line and not re.match(r"(?:TEST|BENCHMARK|MATCHER|PANVO|INSTANTIATE|TYPED)\w*\(", line):
            function = FUNCTION.match(line)
            # Constructors and destructors have the name of their type.
            if function and not CONSTANT.fullmatch(function[1]) and not re.search(rf"\b{function[1]}::~?{function[1]}\(|~{function[1]}\(", line):
                expect(function, SNAKE, "functions are snake_case")
        access = ACCESS.match(line)
        if access:
            private_from = len(access[1]) if access[2] == "private" else None
        elif private_from is not None:
            if re.match(rf"\s{{0,{max(private_from - 1, 0)}}}\}}", line):
                private_from = None  # the class ends
            elif len(line) - len(line.lstrip()) == private_from + 1 and (member := MEMBER.match(line)) and not member[1].endswith("_"):
                complaints.append(f"{path}:{number}: {member[1]}: private members end in _")
    return complaints


def check(root):
    complaints = list(file_names(root))
    for path in workspace.cpp_files(root):
        complaints += check_text(path, workspace.read(root, path))
    return complaints


if __name__ == "__main__":
    workspace.run(check)
