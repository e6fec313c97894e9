# SPDX-License-Identifier: Apache-2.0
"""Pages of the manual: the guides, and Markdown files of the whole checkout. Each keeps its path, so links between them need no change."""
import os
import pathlib
import posixpath
import re
import sys

from mkdocs.structure.files import File, Files

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "lint"))
import links  # noqa: E402

PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "config/manual/guides/*.md", "config/*/README.md", "interfaces/README.md",
         "components/*/*.md", "drivers/*/README.md", "tests/README.md")
LABELLED = re.compile(r"\[(?P<label>[^\[\]]*)\]\((?P<target>[^()\s#]+)(?P<anchor>#[^()\s]*)?\)")


def linked_path(page_path, target):
    """The path from the root that a link of a page leads to."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(page_path), target))


def show_as_text(file):
    """Gives a source file a name under which browsers show it instead of saving it."""
    if "." in posixpath.basename(file.src_uri):  # MkDocs changes no link to another name
        for name in ("dest_uri", "abs_dest_path", "url"):
            setattr(file, name, getattr(file, name) + ".txt")


def on_config(config):
    """Lists the packages in the navigation, so that a new one appears by itself."""
    packages = [{path.parent.name: path.relative_to(ROOT).as_posix()}
                for folder in ("components/*", "drivers/*", "interfaces") for path in sorted(ROOT.glob(f"{folder}/README.md"))]
    for entry in config["nav"]:
        if "Packages" in entry:
            entry["Packages"] = packages
    return config


def on_files(found, config):
    """The theme's files, the pages, the files they link to, and the API reference that Doxygen wrote into $PANVO_API/api."""
    files = {file.src_uri: file for file in found if not file.abs_src_path.startswith(config["docs_dir"])}

    def add(path, folder=ROOT):
        files.setdefault(path, File(path, str(folder), config["site_dir"], config["use_directory_urls"]))
        return files[path]

    pages = [page.relative_to(ROOT).as_posix() for pattern in PAGES for page in sorted(ROOT.glob(pattern))]
    for path in pages:
        add(path)
    for path in pages:
        for _line, target in links.links_of((ROOT / path).read_text(encoding="utf-8")):
            linked = linked_path(path, target.partition("#")[0] or posixpath.basename(path))
            if (ROOT / linked).is_file() and linked not in files:
                show_as_text(add(linked))
    api = pathlib.Path(os.environ["PANVO_API"])
    for file in sorted(api.rglob("*")):
        if file.is_file():
            add(file.relative_to(api).as_posix(), api)
    return Files(list(files.values()))


def on_page_markdown(markdown, page, **_):
    """A link to a folder leads to its README; without one, only the label remains."""

    def rewrite(link):
        linked = linked_path(page.file.src_uri, link["target"])
        if not (ROOT / linked).is_dir():
            return link[0]
        readme = posixpath.join(link["target"], "README.md")
        return f"[{link['label']}]({readme})" if (ROOT / linked / "README.md").is_file() else link["label"]

    return LABELLED.sub(rewrite, markdown)
