# SPDX-License-Identifier: Apache-2.0
"""The page of `panvo bench places`, with a program in place of panvo's."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import places  # noqa: E402

# Writes what the drive's file "result" holds.
EVALUATE = """
import pathlib, shutil, sys
assert sys.argv[2] == "--library-from" and "--only-journey" in sys.argv
out = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
out.mkdir(parents=True, exist_ok=True)
shutil.copy(pathlib.Path(sys.argv[1]) / "result", out / "places.json")
"""


class Places(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "bin").mkdir()
        program = self.folder / "bin" / "panvo_evaluate_places"
        program.write_text(f"#!{sys.executable}\n{EVALUATE}", encoding="utf-8")
        program.chmod(0o755)

    def make_drive(self, name, errors, revisits, wrong=0):
        """A drive that recognises a place for each error of position, m, besides wrong ones."""
        (self.folder / name).mkdir()
        found = [{"right": True, "position_error_m": error, "heading_error_deg": -2 * error} for error in errors]
        bad = [{"right": False, "position_error_m": 50.0, "heading_error_deg": 90.0}] * wrong
        result = {"revisits": revisits, "panoramas": 300, "journey": {"found": len(errors), "wrong": wrong, "matches": found + bad}}
        (self.folder / name / "result").write_text(json.dumps(result), encoding="utf-8")
        return name, self.folder / name

    def write_page(self, *pairs):
        out = self.folder / "page.md"
        arguments = [word for name, drive in pairs for word in ("--pair", name, self.folder / "library", drive)]
        done = subprocess.run([sys.executable, "-B", places.__file__, "--programs", self.folder / "bin", "--work", self.folder / "work", "--out", out,
                               "--version-text", "0.2.0", *arguments], capture_output=True, text=True, check=False)
        return done, out.read_text(encoding="utf-8") if out.exists() else ""

    def test_adds_the_drives_of_a_condition(self):
        drives = [self.make_drive("snow", errors, 10) for errors in ([0.1, 0.2, 0.3], )]
        done, page = self.write_page(*drives, ("snow", self.make_drive("again", [0.4] * 6, 10)[1]))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| snow | 2 | 9 of 20 | 45 (26 to 66) | 0.40 | 0.40 | 0.40 | 0.80 | 600 | 0 | 5.0e-03 |", page)

    def test_a_wrong_match_does_not_count_as_error_of_position(self):
        _, page = self.write_page(self.make_drive("hour", [0.1, 0.2], 2, wrong=1))
        self.assertIn("| hour | 1 | 2 of 2 | 100 (34 to 100) | 0.20 | 0.20 | 0.20 | 0.40 | 300 | 1 | 1.6e-02 |", page)

    def test_on_another_campus_every_match_is_wrong(self):
        _, page = self.write_page(self.make_drive("elsewhere", [0.1], 1), self.make_drive("elsewhere, hall", [], 0))
        self.assertIn("| elsewhere | 1 | - | - | - | - | - | - | 300 | 1 | 1.6e-02 |", page)
        self.assertIn("| elsewhere, hall | 1 | - | - | - | - | - | - | 300 | 0 | 1.0e-02 |", page)

    def test_a_condition_without_matches_has_no_errors(self):
        _, page = self.write_page(self.make_drive("snow", [], 5))
        self.assertIn("| snow | 1 | 0 of 5 | 0 (0 to 43) | - | - | - | - | 300 | 0 | 1.0e-02 |", page)

    def test_names_what_was_not_measured(self):
        done, page = self.write_page(self.make_drive("hour", [0.1], 1), ("snow", self.folder / "nowhere"))
        self.assertEqual(done.returncode, 0)
        self.assertIn("- snow, nowhere: panvo_evaluate_places: ", page)

    def test_fails_if_nothing_was_measured(self):
        done, page = self.write_page(("snow", self.folder / "nowhere"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("Nothing was measured.", page)

    def test_bounds_of_rare_events_are_the_known_ones(self):
        for count, bound in ((0, 2.996), (1, 4.744), (2, 6.296), (10, 16.962)):
            self.assertAlmostEqual(places.most_expected(count), bound, places=3)


if __name__ == "__main__":
    unittest.main()
