# SPDX-License-Identifier: Apache-2.0
"""Recordings as arguments: layouts of data sets, and bags in place of run folders."""
import os
import pathlib
import subprocess
import tempfile
import unittest

from command_test import ROOT, install, panvo, write_program
from made_up_recordings import SENSOR

LIBRARY = ROOT / "launch_scripts" / "lib" / "datasets.sh"


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name, "my recordings")
        self.folder.mkdir()

    def write(self, *names, text=""):
        for name in names:
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_text(text, encoding="utf-8")


class Layouts(Scratch):
    def ask(self, function, name):
        done = subprocess.run(["bash", "-euc", 'source "$1"; "$2" "$3"', "bash", LIBRARY, function, name], cwd=self.folder,
                              capture_output=True, text=True, timeout=60, check=True)
        return done.stdout.strip()

    def test_are_those_of_the_data_set_player(self):
        self.write("grey/calib.txt", "grey/image_0/0.png", "grey/image_1/0.png", "colour/calib.txt", "colour/image_2/0.png", "colour/image_3/0.png",
                   "euroc/mav0/cam0/data.csv", "euroc/mav0/cam1/data.csv", "pair/left/0.png", "pair/right/0.png",
                   "mixed/calib.txt", "mixed/image_0/0.png", "mixed/image_3/0.png", "panorama/mav0/cam2/data.csv", "other/0.png")
        kinds = {"grey": "kitti", "colour": "kitti", "euroc": "euroc", "euroc/mav0": "euroc", "pair": "folders", "mixed": "", "panorama": "", "other": ""}
        self.assertEqual({name: self.ask("dataset_kind", name) for name in kinds}, kinds)

    def test_have_ground_truth_where_the_player_finds_it(self):
        self.write("state/mav0/state_groundtruth_estimate0/data.csv", "vicon/mav0/vicon0/data.csv", "mocap/mav0/mocap0/data.csv", "beside/poses.txt",
                   "prism/mav0/leica0/data.csv", "one/poses/03.txt", "one/03/0.png", "two/poses/03.txt", "two/sequences/03/0.png", "two/sequences/04/0.png")
        for name in ("state", "state/mav0", "vicon", "mocap", "beside", "one/03", "two/sequences/03"):
            self.assertEqual(self.ask("dataset_ground_truth", name), name)
        for name in ("prism", "two/sequences/04"):
            self.assertEqual(self.ask("dataset_ground_truth", name), "")

    def test_have_a_panorama_only_if_the_third_camera_is_one(self):
        self.write("a/mav0/cam2/sensor.yaml", text=SENSOR)
        self.write("b/mav0/cam2/sensor.yaml", "c/cam2/sensor.yaml", text=SENSOR.replace("pinhole", "equirectangular"))
        self.assertEqual([self.ask("dataset_panorama", name) for name in "abcd"], ["", "b/mav0/cam2", "c/cam2", ""])


class Bags(Scratch):
    """`panvo evaluate` of bags, with programs that print their arguments; panvo_run makes the files of a run."""

    def setUp(self):
        super().setUp()
        self.command, self.programs = install(self.folder / "tree")
        self.let_run_write("odometry_binocular.tum", "ground_truth.tum")
        for name in ("evaluate", "evaluate_journey"):
            write_program(self.programs / f"panvo_{name}", 'for word in "$@"; do echo "<$word>"; done')
        self.write("monday/metadata.yaml", "tuesday.mcap", "wednesday/wednesday_0.db3.zstd", "truth.tum", "run/odometry_binocular.tum", "run/x.mcap")
        self.bags = self.folder.resolve()

    def let_run_write(self, *files):
        """The last argument but those of options is the folder: panvo_run ... --out DIR."""
        write_program(self.programs / "panvo_run", f'echo "$@" >>"{self.folder}/runs.txt"', 'while [ "$1" != --out ]; do shift; done',
                      'mkdir -p "$2"; touch "$2/.panvo_run"', *(f'echo 0 0 0 0 0 0 0 1 >"$2/{file}"' for file in files))

    def evaluate(self, *arguments, **environment):
        return panvo("evaluate", *arguments, command=self.command, cwd=self.folder, **environment)

    def assert_evaluates(self, done, *arguments):
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "".join(f"<{argument}>\n" for argument in arguments), done.stderr)

    def runs(self):
        file = self.folder / "runs.txt"
        return file.read_text(encoding="utf-8").splitlines() if file.exists() else []

    def test_are_evaluated_by_results_beside_them(self):
        for bag in ("monday", "tuesday.mcap", "wednesday/", "wednesday/wednesday_0.db3.zstd"):
            results = f"{self.bags / bag}.results"
            self.assert_evaluates(self.evaluate(bag, "truth.tum", "--no-plot"), results, "truth.tum", "--no-plot")
            self.assertIn(f"play.yaml bag:={self.bags / bag} exclude:=.*/image.* --replay --local --out {results}", self.runs()[-1])

    def test_are_derived_again_for_the_next_evaluation(self):
        for _ in range(2):
            self.assert_evaluates(self.evaluate("monday", "truth.tum"), self.bags / "monday.results", "truth.tum")
        self.assertEqual(len(self.runs()), 2)

    def test_may_hold_the_ground_truth_and_further_estimates(self):
        done = self.evaluate("--title", "monday", "monday", "monday", "--also", "other=tuesday.mcap", "--out", "report")
        self.assert_evaluates(done, "--title", "monday", self.bags / "monday.results", self.bags / "monday.results/ground_truth.tum",
                              "--also", f"other={self.bags / 'tuesday.mcap.results'}", "--out", "report")
        self.assertEqual(len(self.runs()), 2, "a bag is played once")
        self.assert_evaluates(self.evaluate("run", "tuesday.mcap"), "run", self.bags / "tuesday.mcap.results/ground_truth.tum")

    def test_of_journeys_are_evaluated_with_and_without_their_recording(self):
        (self.folder / "data set").mkdir()
        results = self.bags / "monday.results"
        self.assert_evaluates(self.evaluate("journey", "monday", "--only-table"), results, "--only-table")
        self.assert_evaluates(self.evaluate("journey", "data set", "--run", "monday"), results, "--recording", "data set")

    def test_that_lie_in_a_run_or_a_data_set_are_not_taken_for_them(self):
        self.write("data/mav0/vicon0/data.csv", "data/x.mcap")
        self.assert_evaluates(self.evaluate("run", "data"), "run", "data")
        self.assertEqual(self.runs(), [])

    def test_are_evaluated_in_a_temporary_folder_where_theirs_cannot_be_written(self):
        self.write("monday.results")  # a file
        done = self.evaluate("monday", "truth.tum", TMPDIR=str(self.folder))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, rf"<{self.folder}/panvo-results\.\w+>")
        self.assertIn("deriving the results of monday into", done.stderr)

    def test_without_odometry_or_ground_truth_are_refused(self):
        self.let_run_write("ground_truth.tum")
        done = self.evaluate("monday", "truth.tum")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("'monday' holds no odometry of panvo", done.stderr)
        self.assertIn("panvo run enhanced_vo --bag monday --out DIR", done.stderr)
        self.let_run_write("odometry_enhanced.tum")
        (self.folder / "monday.results/ground_truth.tum").unlink()
        self.assertIn("'monday' holds no ground truth", self.evaluate("monday", "monday").stderr)

    def test_never_replace_a_folder_of_somebody_else(self):
        self.write("monday.results/precious")
        done = self.evaluate("monday", "truth.tum")
        self.assertEqual(done.returncode, 1)
        self.assertIn("monday.results' is not from panvo", done.stderr)
        self.assertEqual(os.listdir(self.folder / "monday.results"), ["precious"])

    def test_that_cannot_be_played_fail(self):
        write_program(self.programs / "panvo_run", "echo the bag is damaged >&2; exit 1")
        done = self.evaluate("monday", "truth.tum")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("the bag is damaged", done.stderr)
        self.assertIn("'monday' is not a readable bag, or has no odometry of panvo", done.stderr)
        self.assertIn("panvo run enhanced_vo --bag monday --out DIR", done.stderr)
        write_program(self.programs / "panvo_run", "exit 130")
        self.assertEqual(self.evaluate("monday", "truth.tum").returncode, 130)


if __name__ == "__main__":
    unittest.main()
