# SPDX-License-Identifier: Apache-2.0
import links
import sample


class LinksTest(sample.RuleTest):
    def assert_sound(self, text):
        self.assertEqual(self.complaints(links, {"components/compass/README.md": text}), [])

    def assert_broken(self, expected, text):
        self.assert_finds(links, expected, {"components/compass/README.md": text})

    def test_files_folders_and_headings(self):
        self.assert_sound("[a](../vision/README.md#vision) [b](../vision)\n## How it works, in short\n[c](#how-it-works-in-short)\n")
        self.assert_sound('![a](../../CMakeLists.txt "title") [b](https://example.org/nowhere#x) [c](mailto:a@example.org)\n')

    def test_a_file_that_is_not_there(self):
        self.assert_broken("components/compass/README.md:3: link to ../sight: leads nowhere", "# compass\n\n[a](../sight)\n")
        self.assert_broken("link to gone.md: leads nowhere", "# compass\n\n[a]: gone.md\n")

    def test_a_heading_that_is_not_there(self):
        self.assert_broken("components/vision/README.md has no heading for #use", "[a](../vision/README.md#use)\n")
        self.assert_broken("has no heading for #in-code", "[a](#in-code)\n```\n# in code\n```\n")

    def test_equal_headings_are_numbered(self):
        self.assert_sound("## Use\n## Use\n[a](#use-1)\n")

    def test_ways_out(self):
        self.assert_broken("leads out of the workspace", "[a](../../../elsewhere)\n")
        self.assert_broken("must be relative", "[a](/components/vision)\n")

    def test_code_and_citations_are_no_links(self):
        self.assert_sound("`a[i](x)` and `` [a](`b`) ``\n\n```cpp\nf([this](int) {});\n```\n\n[Lu2015]: Lu, Xiang, Liu 2015, \"Design\".\n")
