# SPDX-License-Identifier: Apache-2.0
"""Completion of the `panvo` command in bash."""
import pathlib
import shlex
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
VERBS = {file.stem for file in (ROOT / "launch_scripts" / "verbs").glob("*.sh")}
SYSTEMS = {file.stem for file in (ROOT / "config" / "systems").glob("*.yaml")}
ROUTES = {file.stem for file in (ROOT / "config" / "routes").glob("*.yaml")}


def completions(line):
    """What bash offers for the last word of the line."""
    words = shlex.join([str(ROOT / "launch_scripts" / "panvo"), *line.split(" ")])
    script = f"source {ROOT}/launch_scripts/completion.bash; COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _panvo; printf '%s\\n' \"${{COMPREPLY[@]}}\""
    done = subprocess.run(["bash", "-eu", "-c", script], capture_output=True, text=True, timeout=60, check=True)
    return set(done.stdout.split())


class Completion(unittest.TestCase):
    def test_offers_every_command(self):
        self.assertEqual(completions(""), VERBS | {"--help", "--version"})

    def test_offers_only_what_begins_like_the_word(self):
        self.assertEqual(completions("te"), {"test", "test-bag"})
        self.assertEqual(completions("run stereo_s"), {"stereo_split"})

    def test_offers_systems_and_routes_by_name(self):
        self.assertEqual(completions("run "), SYSTEMS)
        self.assertEqual(completions("simulate "), ROUTES)

    def test_offers_subcommands(self):
        self.assertEqual(completions("topic "), {"list", "info", "echo", "hz", "bw"})
        self.assertEqual(completions("evaluate "), {"journey", "places"})
        self.assertEqual(completions("component "), {"list", "show", "running", "load", "unload"})

    def test_offers_the_options_in_the_help_of_a_command(self):
        self.assertEqual(completions("demo --"), {"--full", "--seed", "--effects", "--dataset", "--out", "--replay", "--live",
                                                  "--help"})
        self.assertLessEqual({"--dataset", "--bag", "--out", "--replay", "--set"}, completions("run stereo --"))

    def test_leaves_other_words_to_bash_which_completes_files(self):
        self.assertEqual(completions("run stereo "), set())
        self.assertEqual(completions("run stereo --dataset "), set())


if __name__ == "__main__":
    unittest.main()
