# SPDX-License-Identifier: Apache-2.0
import files
import sample

L = sample.LICENCE


class FilesTest(sample.RuleTest):
    def test_a_whole_workspace_breaks_nothing(self):
        self.assertEqual(self.complaints(files), [])

    def test_a_source_without_licence_line(self):
        self.assert_finds(files, "a.cpp:1: the file must begin with", {"components/vision/src/a.cpp": "int a;\n"})

    def test_a_header_without_guard(self):
        self.assert_finds(files, "#pragma once", {"components/vision/src/a.hpp": L + "int a;\n"})

    def test_a_path_of_one_machine(self):
        self.assert_finds(files, "machine-specific path", {"README.md": "see /" + "home/somebody/panvo\n"})
        self.assertEqual(self.complaints(files, {"README.md": "runs/work/a, ../shared/data and https://example.org/home/a\n"}), [])

    def test_a_test_that_sleeps(self):
        line = "void wait() { std::this_thread::sleep_for(std::chrono::seconds(1)); }\n"
        self.assert_finds(files, "not for time", {"components/vision/test/a_test.cpp": L + line})
        self.assertEqual(self.complaints(files, {"components/vision/test/a_test.cpp": L + "// sleep_for( in words\n"}), [])

    def test_a_test_that_looks_again_in_a_moment(self):
        line = "void look() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }\n"
        self.assertEqual(self.complaints(files, {"components/vision/test/a_test.cpp": L + line}), [])

    def test_a_test_that_shares_a_file_with_others(self):
        for place in ("std::filesystem::temp_directory_path() / ", "testing::TempDir() + "):
            self.assert_finds(files, "at the same time", {"components/vision/test/a_test.cpp": L + f'const auto file = {place}"a.txt";\n'})

    def test_blanks_at_the_end_and_a_last_line_without_end(self):
        self.assert_finds(files, "trailing white space", {"components/vision/src/a.cpp": L + "int a; \n"})
        self.assert_finds(files, "no newline at end", {"components/vision/src/a.cpp": L + "int a;"})

    def test_what_a_build_leaves_is_no_source(self):
        self.assertEqual(self.complaints(files, {"build/a.cpp": "int a;", "install/a.cpp": "int a;"}), [])
