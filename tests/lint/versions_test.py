# SPDX-License-Identifier: Apache-2.0
import pathlib
import tempfile

import sample
import versions


class VersionsTest(sample.RuleTest):
    def test_a_whole_workspace_breaks_nothing(self):
        self.assertEqual(self.complaints(versions), [])

    def test_another_version_in_package_xml(self):
        self.assert_finds(versions, "components/vision/package.xml: version 0.2.0",
                          {"components/vision/package.xml": sample.package_xml("panvo_vision", version="0.2.0")})

    def test_another_version_in_cmake(self):
        lists = sample.cmake_lists("panvo_vision").replace("0.1.0", "0.1")
        self.assert_finds(versions, "components/vision/CMakeLists.txt: version 0.1,", {"components/vision/CMakeLists.txt": lists})

    def test_a_package_without_version(self):
        name = "components/vision/CMakeLists.txt"
        self.assert_finds(versions, f"{name}: has no version", {name: "project(panvo_vision)\n"})

    def test_a_changelog_of_another_release(self):
        self.assert_finds(versions, "the newest release is 0.0.9", {"CHANGELOG.md": "## [Unreleased]\n\n## [0.0.9] - 2026-01-01\n"})
        self.assert_finds(versions, "the newest release is none", {"CHANGELOG.md": "## [Unreleased]\n"})
        self.assertEqual(self.complaints(versions, {"CHANGELOG.md": "## [0.1.0] - 2026-02-01\n\n## [0.0.9] - 2026-01-01\n"}), [])

    def test_fix_writes_the_version_of_the_root_everywhere(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            sample.write(root, {"CMakeLists.txt": sample.whole_workspace()["CMakeLists.txt"].replace("0.1.0", "0.3.0")})
            self.assertEqual(len(versions.check(root)), 8, "both files of four packages")
            versions.fix(root)
            self.assertEqual(versions.check(root), [])
            self.assertIn("<version>0.3.0</version>", (root / "components/vision/package.xml").read_text(encoding="utf-8"))
