# SPDX-License-Identifier: Apache-2.0
"""The page of `panvo bench report`, with programs in place of panvo's."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import report  # noqa: E402

PAIR = "stereo/left/image_rect, stereo/right/image_rect"
ESTIMATE = {"poses": 99, "path_length_m": 57.6, "ate_start_m": {"rmse": 0.25}, "ate_se3_m": {"rmse": 0.0814}, "segments": {"translation_percent": 0.78},
            "end_error_percent": 0.53, "nees": {"motion": {"mean": 6.6}},
            "timing": [{"component": "binocular_odometry", "stage": PAIR, "cpu_ms": {"mean": 8.0}},
                       {"component": "binocular_odometry", "stage": "motion", "cpu_ms": {"mean": 4.5}},
                       {"component": "stereo_rectifier", "stage": "motion", "cpu_ms": {"mean": 100.0}}]}
BENCHMARK = {"benchmarks": [{"name": "tracking/kitti_03/klt", "real_time": 8.126, "cpu_time": 8.0, "time_unit": "ms", "features": 312.0},
                            {"name": "motion/none", "error_occurred": True, "error_message": "no recording none"}]}


class Report(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "data" / "kitti_03").mkdir(parents=True)
        (self.folder / "bin").mkdir()

    def make_program(self, name, text):
        file = self.folder / "bin" / name
        file.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
        file.chmod(0o755)

    def make_programs(self):
        self.make_program("panvo_run", f'echo "$@" >"{self.folder}/run_arguments"')
        self.make_program("panvo_evaluate", f"cat <<'END'\n{json.dumps({'estimates': [ESTIMATE]})}\nEND")
        self.make_program("panvo_odometry_benchmark", f"cat <<'END'\n{json.dumps(BENCHMARK)}\nEND")

    def write_page(self, *options):
        out = self.folder / "page.md"
        done = subprocess.run([sys.executable, "-B", report.__file__, "--programs", self.folder / "bin", "--systems", "systems", "--data",
                               self.folder / "data", "--work", self.folder / "work", "--out", out, "--version-text", "0.2.0", *options],
                              capture_output=True, text=True, check=False)
        return done, out.read_text(encoding="utf-8") if out.exists() else ""

    def test_shows_figures_of_recordings_and_benchmarks(self):
        self.make_programs()
        done, page = self.write_page("--quick")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| kitti_03 | stereo | binocular | 99 | 58 | 0.250 | 0.081 | 0.780 | 0.530 | 6.6 | 12.5 |", page)
        self.assertIn("| tracking/kitti_03/klt | 8.126 | 8 | ms | features 312 |", page)
        self.assertIn("panvo 0.2.0", page)
        self.assertIn("--replay --seed 1", (self.folder / "run_arguments").read_text(encoding="utf-8"))

    def test_lists_what_could_not_be_measured(self):
        self.make_programs()
        _, page = self.write_page("--quick")
        for text in ("- campus_clip: not in data/", "- motion/none: no recording none", "- compass: not built"):
            self.assertIn(text, page)

    def test_names_the_program_that_failed(self):
        self.make_programs()
        self.make_program("panvo_run", "echo 'panvo run: no plugin' >&2; exit 2")
        _, page = self.write_page("--quick")
        self.assertIn("- kitti_03: panvo_run: panvo run: no plugin", page)
        self.assertNotIn("| kitti_03 |", page)

    def test_fails_if_nothing_could_be_measured(self):
        done, page = self.write_page("--quick")
        self.assertEqual(done.returncode, 1)
        self.assertIn("No recording was found.", page)

    def test_a_missing_figure_is_no_number(self):
        row = report.accuracy_row("x", "stereo", "binocular", {"poses": 1, "ate_se3_m": None, "timing": []})
        self.assertEqual(row, ["x", "stereo", "binocular", "1", "-", "-", "-", "-", "-", "-", "-"])


if __name__ == "__main__":
    unittest.main()
