# SPDX-License-Identifier: Apache-2.0
"""Output and exit status of the `panvo` command."""
import fcntl
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
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

    def test_of_a_bench_comes_without_building_anything(self):
        for bench in ("accuracy", "faults", "places"):
            done = panvo("bench", bench, "--help")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(f"usage: panvo bench {bench}", done.stdout)
            self.assertIn("--quick", done.stdout)

    def test_version_is_that_of_the_workspace(self):
        version = re.search(r"project\(panvo VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
        self.assertEqual(panvo("--version").stdout, f"panvo {version}\n")

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
        self.assert_fails(2, "unknown option '--fast'", "bench", "faults", "--fast")
        self.assert_fails(2, "unknown option '--fast'", "bench", "accuracy", "--fast")
        self.assert_fails(2, "--seeds 'one': give numbers", "bench", "accuracy", "--seeds", "one")
        self.assert_fails(2, "--only 'noon': choose from hour, night, rain", "bench", "places", "--only", "noon")

    def test_an_option_without_its_value_is_named(self):
        self.assert_fails(2, "--dataset needs a value", "demo", "--dataset")
        self.assert_fails(2, "--sanitize needs a value", "test", "--sanitize")
        self.assert_fails(2, "--only needs a value", "bench", "faults", "--only")

    def test_a_recording_is_compared_with_results_that_are_there(self):
        self.assert_fails(2, "name a recording", "test-bag")
        self.assert_fails(2, "recording 'nowhere' not found", "test-bag", "nowhere", "--expect", "results")
        self.assert_fails(2, "name the results to compare with", "test-bag", ROOT)
        self.assert_fails(2, "--record nowhere creates them", "test-bag", ROOT, "--expect", "nowhere")

    def test_an_unknown_sanitizer_build_and_group(self):
        self.assert_fails(2, "use address, undefined or thread", "build", "--sanitize", "memory")
        self.assert_fails(2, "available: build", "setup", "nothing")

    def test_another_architecture_than_arm64_is_refused(self):
        for verb in ("build", "test"):
            self.assert_fails(2, "unknown architecture 'riscv64'; use arm64", verb, "--arch", "riscv64")
            self.assert_fails(2, "--arch needs a value", verb, "--arch")

    def test_an_unknown_system_gets_the_nearest_one(self):
        self.assert_fails(2, "did you mean 'demo'", "run", "demmo")
        self.assert_fails(1, "system file 'some/where.yaml' not found", "run", "some/where.yaml")


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
            self.assertIn(f"{option} applies to simulated journeys only", done.stderr)

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

    def test_flags_take_no_value(self):
        with tempfile.TemporaryDirectory() as folder:
            command, programs = install(folder)
            write_program(programs / "panvo_simulate", 'echo "$@"')
            done = panvo("simulate", "--random", "3", "--night", "--overcast", "--layout", "rows", "--wet", "--out", "x", command=command, cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "--random 3 --night --overcast --layout rows --wet --out x\n")

    def test_a_bag_can_be_of_another_day(self):
        with tempfile.TemporaryDirectory() as folder:
            command, programs = install(folder)
            write_program(programs / "panvo_simulate", "exit 0")
            write_program(programs / "panvo_run", 'echo "$@"')
            done = panvo("simulate", "--bag", "--random", "3", "--night", "--season", "snow", "--out", "x", command=command, cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("--set simulation.night=true --set simulation.season=snow", done.stdout)

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

    def check_page(self, *known):
        with tempfile.TemporaryDirectory() as folder:
            write_program(pathlib.Path(folder, "dpkg-query"), "printf '%s\\n' " + " ".join(f"'{line}'" for line in known))
            return panvo("setup", "--check", "page", PATH=f"{folder}:{os.environ['PATH']}")

    def test_takes_a_package_for_present_that_an_installed_one_provides(self):
        done = self.check_page("installed nodejs, nodejs-doc (= 20.1), npm")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_takes_a_package_for_missing_whose_provider_was_removed(self):
        done = self.check_page("installed nodejs, ", "config-files other-nodejs, npm")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("npm", done.stdout + done.stderr)


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
            command, programs = install(folder)
            self.assertIn("usage: panvo", panvo("--help", command=command, cwd=folder).stdout)
            built = panvo("build", command=command, cwd=folder)
            self.assertEqual(built.returncode, 1)
            self.assertIn("source checkout", built.stderr)
            write_program(programs / "panvo_run", 'for word in "$@"; do echo "<$word>"; done')
            ran = panvo("run", "--replay", "demo", "--set", "a.b=c d", command=command, cwd=folder)
            system = programs.parent / "share" / "panvo" / "config" / "systems" / "demo.yaml"
            self.assertEqual(ran.stdout, f"<--replay>\n<{system.resolve()}>\n<--set>\n<a.b=c d>\n", ran.stderr)
            for option, value in (("-p", "x:=y"), ("--param", "n:x:=y"), ("-r", "a:=b"), ("--remap", "__ns:=/r1")):
                ran = panvo("run", option, value, "demo", command=command, cwd=folder)
                self.assertEqual(ran.stdout, f"<{option}>\n<{value}>\n<{system.resolve()}>\n", ran.stderr)


def write_program(file, *lines):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("\n".join(("#!/bin/sh", *lines, "")), encoding="utf-8")
    file.chmod(0o755)


def install(folder):
    """An installed panvo without programs: its command and the folder for programs."""
    build, prefix = pathlib.Path(folder, "build"), pathlib.Path(folder, "pre fix")
    subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT / "launch_scripts", "-B", build, f"-DCMAKE_INSTALL_PREFIX={prefix}"], check=True, capture_output=True)
    subprocess.run(["cmake", "--install", build], check=True, capture_output=True)
    return prefix / "bin" / "panvo", prefix / "bin"


class WhatIsBuilt(unittest.TestCase):
    """Commands in a checkout whose programs print their arguments; a build would fail."""
    LOOKING = (("node", "list"), ("topic", "list"), ("param", "list"), ("service", "list"), ("component", "list"), ("component", "running"), ("doctor",),
               ("bag", "info", "b"), ("landmarks", "info", "l"), ("evaluate", "a", "b"), ("devices",), ("run", "demo"))
    PROGRAMS = ("run", "graph", "component", "bag", "landmarks", "evaluate", "devices_v4l2")

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.checkout = pathlib.Path(scratch.name, "checkout")
        for name in ("launch_scripts", "config"):
            shutil.copytree(ROOT / name, self.checkout / name, ignore=shutil.ignore_patterns("__pycache__"))
        (self.checkout / "CMakeLists.txt").write_text('message(FATAL_ERROR "not to be built")', encoding="utf-8")
        self.build = self.checkout / "build" / "release"
        scratch_folder = pathlib.Path(scratch.name)
        scratch_folder.chmod(0o755)

    def make_programs(self):
        for name in self.PROGRAMS:
            write_program(self.build / "panvo_bin" / f"panvo_{name}", f'echo panvo_{name} "$@"')

    def ask(self, *arguments, prefix=()):
        command = self.checkout / "launch_scripts" / "panvo"
        return subprocess.run([*prefix, str(command), *arguments], cwd="/", stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60,
                              check=False, env={"PATH": os.environ["PATH"]})

    def files(self):
        return sorted((str(file), file.stat().st_mtime_ns) for file in self.checkout.rglob("*"))

    def test_is_used_by_all_that_only_look(self):
        self.make_programs()
        before = self.files()
        for arguments in self.LOOKING:
            with self.subTest(arguments=arguments):
                done = self.ask(*arguments)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(done.stdout.startswith("panvo_"), done.stdout)
                self.assertEqual(done.stderr, "")
        self.assertEqual(self.files(), before, "nothing is written")

    def test_is_used_while_somebody_builds(self):
        self.make_programs()
        with open(self.build / ".panvo_lock", "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            done = self.ask("run", "demo")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("panvo_run", done.stdout)
        self.assertIn("is being built; using the existing programs", done.stderr)

    def test_is_used_from_a_checkout_of_another_user(self):
        if os.geteuid() != 0:
            self.skipTest("only root can be another user")
        self.make_programs()
        (self.build / ".panvo_lock").touch(mode=0o600)
        for arguments in self.LOOKING:
            with self.subTest(arguments=arguments):
                done = self.ask(*arguments, prefix=("setpriv", "--reuid=nobody", "--regid=nogroup", "--clear-groups"))
                self.assertEqual(done.returncode, 0, done.stderr)
        built = self.ask("build", prefix=("setpriv", "--reuid=nobody", "--regid=nogroup", "--clear-groups"))
        self.assertEqual(built.returncode, 1)
        self.assertIn("is not writable: build as its owner", built.stderr)

    def test_is_said_when_it_is_not_there(self):
        for arguments in self.LOOKING:
            with self.subTest(arguments=arguments):
                done = self.ask(*arguments)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn("is not built; 'panvo build' builds everything", done.stderr)
        self.assertFalse((self.checkout / "build").exists(), "asking builds nothing")

    def test_is_told_when_it_is_older_than_a_source(self):
        self.make_programs()
        (self.build / ".panvo_built").touch()
        os.utime(self.build / ".panvo_built", (1, 1))
        source = self.checkout / "components" / "odometer" / "src" / "odometer.cpp"
        source.parent.mkdir(parents=True)
        source.touch()
        done = self.ask("run", "demo")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("odometer.cpp is newer than build/release; run 'panvo build' to update", done.stderr)


class Interrupted(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.command, self.programs = install(self.folder)
        self.recording = self.folder / "recording"
        for name in ("image_0", "image_1"):
            (self.recording / name).mkdir(parents=True)
        for name in ("calib.txt", "poses.txt"):
            (self.recording / name).touch()
        write_program(self.programs / "panvo_evaluate", f"touch '{self.folder}/evaluated'")

    def demo(self):
        return [str(self.command), "demo", "--dataset", str(self.recording), "--out", str(self.folder / "out")]

    def test_a_demo_does_not_take_an_interrupted_run_for_finished(self):
        write_program(self.programs / "panvo_run", "exit 130")
        done = subprocess.run(self.demo(), capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 130, done.stderr)
        self.assertIn("interrupted", done.stderr)
        self.assertFalse((self.folder / "evaluated").exists())

    def assert_ends_without_orphans(self, number):
        pids = self.folder / "pids"
        # Background processes of a shell ignore SIGINT; panvo_run does not.
        begin, wait = ("sleep 1000 & echo $$ $!", "wait") if number == signal.SIGTERM else ("echo $$", "exec sleep 1000")
        write_program(self.programs / "panvo_run", f"{begin} >'{pids}.new'; mv '{pids}.new' '{pids}'", wait)
        # As from a terminal: an ignored SIGINT is inherited, and the test may have been started with it.
        demo = subprocess.Popen(self.demo(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        give_up = time.monotonic() + 60
        while not pids.exists():
            self.assertLess(time.monotonic(), give_up, "the run did not begin")
            time.sleep(0.01)
        demo.send_signal(number)
        self.assertEqual(demo.wait(timeout=60), 128 + number)
        for pid in pids.read_text(encoding="utf-8").split():
            status = pathlib.Path("/proc", pid, "status")
            lives = status.exists() and "State:\tZ" not in status.read_text(encoding="utf-8")
            self.assertFalse(lives, f"process {pid} is left")
        self.assertFalse((self.folder / "evaluated").exists())

    def test_sigterm_to_a_demo_leaves_no_orphan(self):
        self.assert_ends_without_orphans(signal.SIGTERM)

    def test_sigint_to_a_demo_leaves_no_orphan(self):
        self.assert_ends_without_orphans(signal.SIGINT)


if __name__ == "__main__":
    unittest.main()
