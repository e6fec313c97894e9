# SPDX-License-Identifier: Apache-2.0
"""The page of `panvo bench accuracy`, with programs in place of panvo's."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import accuracy  # noqa: E402

# Writes the journey of the drive that was replayed: the errors are in its file "errors", and the enhanced ones are half of the odometry's.
EVALUATE = """
import json, pathlib, sys
out, recording = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[3])
error = float((recording / "error").read_text())
path = lambda error: {"flat_rms_m": error, "flat_percent_of_way": error / 2, "heading_rms_deg": 10 * error}
rows = [{"result": "corrected", "after_m": error, "beyond_landmark_m": error / 10, "after_heading_deg": -2 * error}, {"result": "missed", "after_m": None, "beyond_landmark_m": None, "after_heading_deg": None}]
out.mkdir(parents=True, exist_ok=True)
(out / "journey.json").write_text(json.dumps({"run": {
    "paths": {"travelled_m": 200.0, "duration_s": 50.0, "binocular": path(2 * error), "enhanced": path(error), "nees": {"plane": {"mean": 2.0}}},
    "revisits": {"applied": 3, "wrong": 1, "rows": rows}}}))
"""


class Accuracy(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "bin").mkdir()
        self.make_program("panvo_run", "#!/bin/sh\necho \"$@\" >>\"$(dirname \"$0\")/../run_arguments\"\n")
        self.make_program("panvo_evaluate_journey", f"#!{sys.executable}\n{EVALUATE}")

    def make_program(self, name, text):
        file = self.folder / "bin" / name
        file.write_text(text, encoding="utf-8")
        file.chmod(0o755)

    def make_drive(self, name, error):
        (self.folder / name).mkdir()
        (self.folder / name / "error").write_text(str(error), encoding="utf-8")
        return self.folder / name

    def write_page(self, *drives):
        out = self.folder / "page.md"
        done = subprocess.run([sys.executable, "-B", accuracy.__file__, "--programs", self.folder / "bin", "--work", self.folder / "work", "--out", out,
                               "--version-text", "0.2.0", "--drives", *drives], capture_output=True, text=True, check=False)
        return done, out.read_text(encoding="utf-8") if out.exists() else ""

    def test_gives_mean_interval_and_worst_over_the_drives(self):
        done, page = self.write_page("stereo", "short", self.make_drive("a", 0.1), self.make_drive("b", 0.3))
        self.assertEqual(done.returncode, 0, done.stderr)
        # Two drives: the interval is 12.706 times the standard deviation of the mean, 0.1.
        self.assertIn("| short | stereo | 2 | 200 | 0.40 ± 2.54 (0.60) | 0.200 ± 1.271 (0.300) | 4.00 ± 25.41 (6.00) | - |", page)
        self.assertIn("| short | stereo + panorama | 2 | 200 | 0.20 ± 1.27 (0.30) |", page)
        self.assertIn("| 0.20 ± 1.27 (0.30) | 0.02 ± 0.13 (0.03) | 0.40 ± 2.54 (0.60) | 6, 2 | 2.0 ± 0.0 (2.0) |", page)

    def test_replays_each_system_of_the_kind(self):
        self.write_page("panorama", "long", self.make_drive("a", 0.1))
        runs = (self.folder / "run_arguments").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(runs), 3)
        self.assertIn("modelled_odometry.yaml --dataset", runs[0])
        self.assertIn("modelled_odometry.yaml sensors:=true --dataset", runs[1])
        self.assertIn("modelled_odometry.yaml gnss:=true --dataset", runs[2])
        self.assertTrue(all("--replay --seed 1" in arguments for arguments in runs))

    def test_a_single_drive_has_no_interval(self):
        _, page = self.write_page("stereo", "short", self.make_drive("a", 0.25))
        self.assertIn("| short | stereo + panorama | 1 | 200 | 0.25 | 0.125 | 2.50 |", page)

    def test_names_the_drive_that_failed_and_shows_the_others(self):
        self.make_program("panvo_run", "#!/bin/sh\ncase \"$*\" in */bad*) echo 'panvo run: broken image' >&2; exit 1;; esac\n")
        _, page = self.write_page("stereo", "short", self.make_drive("good", 0.1), self.make_drive("bad", 0.3))
        self.assertIn("- short, bad, stereo + panorama: panvo_run: panvo run: broken image", page)
        self.assertIn("| short | stereo + panorama | 1 | 200 | 0.10 |", page)

    def test_fails_if_nothing_could_be_measured(self):
        self.make_program("panvo_run", "#!/bin/sh\nexit 1\n")
        done, page = self.write_page("stereo", "short", self.make_drive("a", 0.1))
        self.assertEqual(done.returncode, 1)
        self.assertIn("Nothing was measured.", page)

    def test_refuses_a_kind_that_it_does_not_know(self):
        done, _ = self.write_page("lidar", "short", self.make_drive("a", 0.1))
        self.assertEqual(done.returncode, 2)
        self.assertIn("needs a kind (stereo, panorama)", done.stderr)


if __name__ == "__main__":
    unittest.main()
