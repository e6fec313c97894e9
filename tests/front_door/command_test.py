# SPDX-License-Identifier: Apache-2.0
"""The front door by itself: what it says, and with which exit status."""
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PANVO = ROOT / "launch_scripts" / "panvo"
VERBS = sorted(file.stem for file in (ROOT / "launch_scripts" / "verbs").glob("*.sh"))


def panvo(*arguments, command=PANVO, cwd=ROOT, **environment):
    clean = {name: value for name, value in os.environ.items() if not name.startswith("PANVO_")}
    return subprocess.run([str(command), *map(str, arguments)], cwd=cwd, env={**clean, **environment}, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=60, check=False)


class Help(unittest.TestCase):
    def test_lists_every_verb_with_a_line(self):
        lines = panvo("--help").stdout.splitlines()
        for verb in VERBS:
            self.assertTrue(any(len(line.split()) > 1 and line.split()[0] == verb for line in lines), f"{verb} is not in the list")

    def test_every_verb_has_a_text_of_its_own(self):
        for verb in VERBS:
            with self.subTest(verb=verb):
                done = panvo(verb, "--help")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(f"usage: panvo {verb}", done.stdout)

    def test_without_a_verb_it_helps_and_fails(self):
        done = panvo()
        self.assertEqual(done.returncode, 2)
        self.assertIn("usage: panvo", done.stdout)


class Mistakes(unittest.TestCase):
    def assert_fails(self, status, words, *arguments, **environment):
        done = panvo(*arguments, **environment)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.assertIn(words, done.stderr)
        self.assertEqual(done.stdout, "", "errors belong on stderr")

    def test_an_unknown_verb_gets_the_nearest_one(self):
        self.assert_fails(2, 'did you mean "panvo demo"', "dmeo")
        self.assert_fails(2, 'did you mean "panvo evaluate"', "eval")

    def test_an_unknown_option_is_named(self):
        self.assert_fails(2, "unknown option '--sanitise'", "build", "--sanitise")
        self.assert_fails(2, "unknown option '--all'", "devices", "--all")

    def test_an_option_without_its_value_is_named(self):
        self.assert_fails(2, "--dataset needs a value", "demo", "--dataset")
        self.assert_fails(2, "--sanitize needs a value", "test", "--sanitize")

    def test_a_recording_is_compared_with_results_that_are_there(self):
        self.assert_fails(2, "which recording?", "test-bag")
        self.assert_fails(2, "there is no recording 'nowhere'", "test-bag", "nowhere", "--expect", "results")
        self.assert_fails(2, "compare with what?", "test-bag", ROOT)
        self.assert_fails(2, "--record nowhere makes them", "test-bag", ROOT, "--expect", "nowhere")

    def test_an_unknown_sanitizer_build_and_group(self):
        self.assert_fails(2, "there are address, undefined and thread", "build", "--sanitize", "memory")
        self.assert_fails(2, "there are: build", "setup", "nothing")

    def test_an_unknown_system_gets_the_nearest_one(self):
        self.assert_fails(2, "did you mean 'demo'", "run", "demmo")
        self.assert_fails(1, "there is no system file 'some/where.yaml'", "run", "some/where.yaml")


class Demo(unittest.TestCase):
    def test_a_folder_that_is_no_recording_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            done = panvo("demo", "--dataset", folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn(folder, done.stderr)

    def test_what_is_of_simulated_journeys_goes_without_a_recording(self):
        for option, value in (("--seed", "7"), ("--effects", "movers,rain")):
            done = panvo("demo", "--dataset", ROOT, option, value)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"{option} is of the simulated journeys", done.stderr)

    def test_effects_are_names(self):
        done = panvo("demo", "--effects", "movers; rain")
        self.assertEqual(done.returncode, 2)
        self.assertIn("not 'movers; rain'", done.stderr)

    def test_results_are_never_overwritten(self):
        with tempfile.TemporaryDirectory() as folder:
            recording, out = pathlib.Path(folder, "recording"), pathlib.Path(folder, "out")
            for name in ("image_0", "image_1"):
                (recording / name).mkdir(parents=True)
            (recording / "calib.txt").touch()
            out.mkdir()
            (out / "precious").touch()
            done = panvo("demo", "--dataset", recording, "--out", out)
            self.assertEqual(done.returncode, 1)
            self.assertIn("not empty", done.stderr)
            self.assertEqual([file.name for file in out.iterdir()], ["precious"])


class Simulate(unittest.TestCase):
    def test_help_lists_the_routes_with_what_they_are_for(self):
        done = panvo("simulate", "--help")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("short", "corner", "dataset_i", "dataset_ii"):
            self.assertRegex(done.stdout, rf"(?m)^  {name} +\w.{{20}}")

    def test_an_unknown_route_gets_the_nearest_one(self):
        done = panvo("simulate", "shrot", "--out", "/nowhere")
        self.assertEqual(done.returncode, 2)
        self.assertIn("did you mean 'short'", done.stderr)
        self.assertEqual(done.stdout, "")

    def test_an_option_without_its_value_is_named(self):
        done = panvo("simulate", "short", "--out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--out needs a value", done.stderr)

    def test_what_a_bag_cannot_have_is_named(self):
        done = panvo("simulate", "short", "--bag", "--out", "/nowhere", "--pictures", "3")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--pictures", done.stderr)


class Setup(unittest.TestCase):
    def test_lists_each_package_once_and_without_its_comment(self):
        names = panvo("setup", "--list", "--all").stdout.split()
        self.assertIn("libeigen3-dev", names)
        self.assertEqual(sorted(names), sorted(set(names)))
        self.assertFalse([name for name in names if not name.replace("+", "").replace("-", "").replace(".", "").isalnum()])


class Anywhere(unittest.TestCase):
    def test_from_another_folder_through_a_chain_of_links(self):
        with tempfile.TemporaryDirectory() as folder:
            first, second = pathlib.Path(folder, "first"), pathlib.Path(folder, "second")
            first.symlink_to(PANVO)
            second.symlink_to("first")
            done = panvo("setup", "--list", command=second, cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("cmake", done.stdout.split())

    def test_once_installed(self):
        with tempfile.TemporaryDirectory() as folder:
            build, prefix = pathlib.Path(folder, "build"), pathlib.Path(folder, "pre fix")
            subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT / "launch_scripts", "-B", build, f"-DCMAKE_INSTALL_PREFIX={prefix}"], check=True, capture_output=True)
            subprocess.run(["cmake", "--install", build], check=True, capture_output=True)
            command = prefix / "bin" / "panvo"
            self.assertIn("usage: panvo", panvo("--help", command=command, cwd=folder).stdout)
            built = panvo("build", command=command, cwd=folder)
            self.assertEqual(built.returncode, 1)
            self.assertIn("source checkout", built.stderr)
            program = prefix / "bin" / "panvo_run"
            program.write_text('#!/bin/sh\nfor word in "$@"; do echo "<$word>"; done\n', encoding="utf-8")
            program.chmod(0o755)
            ran = panvo("run", "--replay", "demo", "--set", "a.b=c d", command=command, cwd=folder)
            system = prefix / "share" / "panvo" / "config" / "systems" / "demo.yaml"
            self.assertEqual(ran.stdout, f"<--replay>\n<{system.resolve()}>\n<--set>\n<a.b=c d>\n", ran.stderr)


if __name__ == "__main__":
    unittest.main()
