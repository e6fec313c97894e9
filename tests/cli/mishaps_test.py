# SPDX-License-Identifier: Apache-2.0
"""The `panvo` command where something goes wrong: interruptions, full disks, programs that fail, paths with spaces."""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

from command_test import ROOT, install, panvo, write_program


SCRATCH = tempfile.TemporaryDirectory()
PREFIX = install(SCRATCH.name)[1].parent  # installed once, as it takes seconds


class Installed(unittest.TestCase):
    """An installed panvo whose programs are scripts of the test, and whose tools may be replaced."""
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name).resolve()
        shutil.copytree(PREFIX, self.folder / PREFIX.name, symlinks=True)
        self.programs = self.folder / PREFIX.name / "bin"
        self.command = self.programs / "panvo"
        self.tools = self.folder / "tools"

    def ask(self, *arguments, **environment):
        return panvo(*arguments, command=self.command, cwd=self.folder, PATH=f"{self.tools}:{os.environ['PATH']}", **environment)


class ReplayOfABag(Installed):
    def compare(self, *lines):
        write_program(self.programs / "panvo_run", *lines)
        write_program(self.programs / "panvo_compare_runs", "exit 1")
        (self.folder / "bag").mkdir(exist_ok=True)
        (self.folder / "bag" / "metadata.yaml").touch()
        (self.folder / "results").mkdir(exist_ok=True)
        (self.folder / "tmp").mkdir(exist_ok=True)
        return self.ask("test-bag", "bag", "--expect", "results", TMPDIR=str(self.folder / "tmp"))

    def test_of_a_failed_run_the_log_that_is_named_is_there(self):
        done = self.compare('for out; do :; done', 'echo why >"$out/run.log"', "exit 1")
        self.assertEqual(done.returncode, 1)
        log = pathlib.Path(done.stderr.split("its log is ")[1].strip())
        self.assertEqual(log.read_text(encoding="utf-8"), "why\n")

    def test_of_a_run_with_other_results_nothing_stays(self):
        self.assertEqual(self.compare("exit 0").returncode, 1)
        self.assertEqual(list((self.folder / "tmp").iterdir()), [])

    def test_a_refused_run_is_not_taken_for_other_results(self):
        done = self.compare("echo 'no parameter gian' >&2", "exit 2")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the run was refused", done.stderr)


class FullDisk(Installed):
    def test_a_demo_without_a_folder_for_its_results_ends(self):
        recording = self.folder / "recording"
        for name in ("image_0", "image_1"):
            (recording / name).mkdir(parents=True)
        (recording / "calib.txt").touch()
        write_program(self.tools / "mkdir", 'case "$*" in *demo-*) exit 1 ;; esac', f'exec {shutil.which("mkdir")} "$@"')
        done = self.ask("demo", "--dataset", recording)
        self.assertEqual(done.returncode, 1)
        self.assertIn("demo-1'; choose a folder with --out", done.stderr)

    def test_is_named_where_the_results_of_a_bag_do_not_fit(self):
        (self.folder / "monday").mkdir()
        (self.folder / "monday" / "metadata.yaml").touch()
        write_program(self.programs / "panvo_run", "echo 'cannot write odometry_enhanced.tum' >&2", "exit 1")
        write_program(self.tools / "head", "exit 1")  # as where nothing can be written
        done = self.ask("evaluate", "monday", "truth.tum")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the disk is full: free space for the results of 'monday'", done.stderr)
        self.assertNotIn("not a readable bag", done.stderr)
        self.assertEqual(list((self.folder / "monday.results").iterdir()), [])

    def test_is_named_where_there_is_no_folder_for_the_results_of_a_bag(self):
        (self.folder / "monday").mkdir()
        (self.folder / "monday" / "metadata.yaml").touch()
        (self.folder / "monday.results").touch()  # a file
        write_program(self.tools / "mktemp", "exit 1")
        done = self.ask("evaluate", "monday", "truth.tum")
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot create a folder for the results of 'monday'", done.stderr)
        self.assertNotIn("not a readable bag", done.stderr)


class Keystore(Installed):
    """A keystore whose creation was interrupted is completed by the same command."""
    def openssl_until(self, call):
        """Replaces openssl by one that is killed at a call, after it has written a part."""
        count = self.folder / "calls"
        count.write_text("0", encoding="utf-8")
        write_program(self.tools / "openssl", f'n=$(($(cat "{count}") + 1)); echo $n >"{count}"',
                      f'[ $n != {call} ] || {{ for out; do :; done; echo part >"$out"; kill -KILL $PPID; exit 1; }}',
                      f'exec {shutil.which("openssl")} "$@"')

    def test_is_complete_after_any_interruption(self):
        if not shutil.which("openssl"):
            self.skipTest("openssl is not installed")
        names = ("enclaves/panvo/cert.pem", "enclaves/panvo/key.pem", "enclaves/panvo/permissions.p7s", "enclaves/governance.p7s")
        for call in range(1, 9):
            with self.subTest(call=call):
                keystore = self.folder / f"keys {call}"
                self.openssl_until(call)
                self.ask("secure", keystore)
                (self.tools / "openssl").unlink()
                done = self.ask("secure", keystore)
                self.assertEqual(done.returncode, 0, done.stderr)
                for name in names:
                    self.assertGreater((keystore / name).stat().st_size, 100, name)
                checked = subprocess.run(["openssl", "verify", "-CAfile", keystore / "public" / "identity_ca.cert.pem", keystore / names[0]],
                                         capture_output=True, text=True, check=False)
                self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_without_its_private_key_gets_no_second_authority(self):
        if not shutil.which("openssl"):
            self.skipTest("openssl is not installed")
        keystore = self.folder / "keys"
        self.assertEqual(self.ask("secure", keystore).returncode, 0)
        authority = (keystore / "public" / "ca.cert.pem").read_bytes()
        shutil.rmtree(keystore / "private")
        done = self.ask("secure", keystore, "/other")
        self.assertEqual(done.returncode, 2)
        self.assertIn("create enclaves where the keystore was created", done.stderr)
        self.assertEqual((keystore / "public" / "ca.cert.pem").read_bytes(), authority)


class Spaces(Installed):
    def test_in_the_path_of_the_simulators_libraries(self):
        library = self.programs / "libpanvo_simulation.so.0"
        library.touch()
        write_program(self.tools / "ldd", f"printf '\\tlibpanvo_simulation.so.0 => %s (0x0000f0)\\n' '{library}'")
        write_program(self.programs / "panvo_simulate", f'echo "$@" >"{self.folder}/asked"', "exit 1")
        done = self.ask("demo", "--out", "out", HOME=str(self.folder))
        self.assertNotIn("No such file", done.stderr)
        self.assertIn("--route", (self.folder / "asked").read_text(encoding="utf-8"))

    def test_setup_bash_with_a_search_path_for_folders(self):
        share = self.programs.parent / "share" / "panvo"
        script = 'cd "$1" && CDPATH=/nowhere:. && source share/panvo/setup.bash && printf "%s" "$CMAKE_PREFIX_PATH"'
        self.assertTrue((share / "setup.bash").exists())
        done = subprocess.run(["bash", "-c", script, "bash", self.programs.parent], env={"PATH": os.environ["PATH"]},
                              capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, str(self.programs.parent))


class OptionsWithAnEqualsSign(Installed):
    def test_of_view_are_its_own(self):
        write_program(self.programs / "panvo_run", 'echo "$@"')
        (self.folder / "bag").mkdir()
        done = self.ask("view", "--bag=bag", "--port=1234", "--rate=2")
        self.assertIn("bag:=bag", done.stdout)
        self.assertIn("port:=1234", done.stdout)
        self.assertIn("--rate 2", done.stdout)
        self.assertNotIn("--rate 1", done.stdout)

    def test_of_tls_name_files_wherever_the_system_file_is(self):
        write_program(self.programs / "panvo_run", 'echo "$@"')
        done = self.ask("view", "--tls-certificate=cert.pem", "--tls-key", "keys/key.pem")
        self.assertIn("open https://127.0.0.1:8765 in a browser, or wss://127.0.0.1:8765 in Foxglove", done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"tls_certificate:=/\S*/cert\.pem tls_key:=/\S*/keys/key\.pem")


class Supervision(unittest.TestCase):
    def supervise(self, line, function="echo $BASHPID >{pid}; sleep 1000"):
        """Runs a function under supervision that would go on for ever. `line` comes before; {pid}: a file, once it runs."""
        with tempfile.TemporaryDirectory() as folder:
            pid = pathlib.Path(folder, "pid")
            script = "\n".join((f"PANVO_SCRIPTS={ROOT / 'launch_scripts'}", f"source '{ROOT}/launch_scripts/lib/common.sh'",
                                f"source '{ROOT}/launch_scripts/lib/supervise.sh'", "set -euo pipefail", line.replace("{pid}", f"'{pid}'"),
                                f"forever() {{ {function.replace('{pid}', str(pid))}; }}", "supervise forever"))
            try:
                done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=60, check=False,
                                      preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
            finally:
                process = int(pid.read_text(encoding="utf-8")) if pid.exists() else 0
                stat = pathlib.Path("/proc", str(process), "stat")
                lives = process > 0 and stat.exists() and ") Z " not in stat.read_text(encoding="utf-8")
                if lives:
                    os.killpg(os.getpgid(process), signal.SIGKILL)
        return done, lives

    def test_begins_before_the_program_does(self):
        # The shell is interrupted as soon as the program has begun.
        done, lives = self.supervise('set() { builtin set "$@"; [[ $1 != +m ]] || { until [[ -s {pid} ]]; do sleep 0.01; done; kill -INT $$; }; }')
        self.assertEqual(done.returncode, 130, done.stderr)
        self.assertFalse(lives, "the program is left")

    def test_ends_what_runs_in_the_background_of_a_function_that_failed(self):
        done, lives = self.supervise("", "sleep 1000 >/dev/null 2>&1 & echo $! >{pid}; exit 3")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertFalse(lives, "the program in the background is left")


if __name__ == "__main__":
    unittest.main()
