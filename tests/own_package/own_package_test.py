# SPDX-License-Identifier: Apache-2.0
"""Creates a package outside the tree with an installed panvo: `panvo new component`, cmake, ctest, install, run."""
import argparse
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAME = "trip_meter"
LIMIT_S = 60


def claimed_domain():
    """A DDS domain that no other test uses (see panvo/runtime/test_domain.hpp), and the socket that claims it, which must stay open."""
    for domain in range(1 + os.getpid() % 99, 100):
        claim = socket.socket(socket.AF_UNIX)
        try:
            claim.bind(f"\0panvo_test_domain_{domain}")
            return domain, claim
        except OSError:
            claim.close()
    raise RuntimeError("every DDS domain for tests is claimed")


def sourced(setup, environment):
    """The environment after `. setup`."""
    done = subprocess.run(["bash", "-c", f'. "{setup}" && env -0'], env=environment, capture_output=True, check=True)
    return dict(entry.split("=", 1) for entry in done.stdout.decode().split("\0") if entry)


def prefix_with_fast_cdr_2(prefix):
    """A prefix with Fast CDR 2, as that of a sourced ROS 2 is, which must not be used."""
    package = prefix / "lib/cmake/fastcdr"
    package.mkdir(parents=True)
    (package / "fastcdr-config.cmake").write_text('message(FATAL_ERROR "Fast CDR of another version is used")\n', encoding="utf-8")
    (package / "fastcdr-config-version.cmake").write_text(
        'set(PACKAGE_VERSION 2.2.5)\n'
        'if(NOT PACKAGE_FIND_VERSION OR PACKAGE_FIND_VERSION_MAJOR EQUAL 2)\n  set(PACKAGE_VERSION_COMPATIBLE TRUE)\nendif()\n', encoding="utf-8")
    return prefix


class OwnPackage(unittest.TestCase):
    build = None

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="panvo_own_package_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        domain, claim = claimed_domain()
        cls.addClassCleanup(claim.close)
        cls.environment = {name: value for name, value in os.environ.items() if not name.startswith("PANVO_") or name == "PANVO_DATA"}
        cls.environment.update(ROS_DOMAIN_ID=str(domain), ROS_LOCALHOST_ONLY="1")
        if cls.build:
            prefix = cls.folder / "prefix"
            subprocess.run(["cmake", "--install", cls.build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
            cls.environment = sourced(prefix / "share/panvo/setup.bash", cls.environment)
        ros = prefix_with_fast_cdr_2(cls.folder / "ros")
        cls.environment["CMAKE_PREFIX_PATH"] = f"{ros}:{cls.environment.get('CMAKE_PREFIX_PATH', '')}"
        cls.package = cls.folder / NAME
        cls.run_command("panvo", "new", "component", NAME, "--in", cls.folder)
        own = cls.folder / "own"
        cls.run_command("cmake", "-S", cls.package, "-B", cls.folder / "build", "-DCMAKE_BUILD_TYPE=Debug", f"-DCMAKE_INSTALL_PREFIX={own}")
        cls.run_command("cmake", "--build", cls.folder / "build", "--parallel", "2")
        cls.run_command("cmake", "--install", cls.folder / "build")
        cls.environment["CMAKE_PREFIX_PATH"] = f"{own}:{cls.environment.get('CMAKE_PREFIX_PATH', '')}"

    @classmethod
    def run_command(cls, *command, status=0, limit_s=300):
        done = subprocess.run(list(map(str, command)), cwd=cls.folder, env=cls.environment, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=limit_s, check=False)
        if done.returncode != status:
            raise AssertionError(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stdout}\n{done.stderr}")
        return done.stdout + done.stderr

    def start(self, *command):
        process = subprocess.Popen(list(map(str, command)), cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

        def end():
            process.send_signal(signal.SIGTERM)
            try:
                process.communicate(timeout=LIMIT_S)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()

        self.addCleanup(end)
        return process

    def eventually(self, look):
        """Calls `look` until its result is not None, and returns it. The test fails after LIMIT_S."""
        end = time.monotonic() + LIMIT_S
        while time.monotonic() < end:
            found = look()
            if found is not None:
                return found
        self.fail(f"nothing in {LIMIT_S} s")

    def test_passes_its_own_tests(self):
        said = self.run_command("ctest", "--test-dir", self.folder / "build", "--output-on-failure")
        self.assertIn("100% tests passed, 0 tests failed out of 4", said)

    def test_says_what_its_tests_need(self):
        configure = ("cmake", "-S", self.package, "-B", self.folder / "without_gtest", "-DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON")
        said = " ".join(self.run_command(*configure, status=1).split())  # CMake wraps lines
        self.assertIn("apt-get install libgmock-dev", said)
        self.run_command(*configure, "-DBUILD_TESTING=OFF")

    def test_parameters_are_shown(self):
        said = self.run_command("panvo", "component", "show", NAME)
        self.assertIn("min_step_m", said)
        self.assertIn("shorter steps are noise", said)

    def test_showing_a_component_leaves_no_files(self):
        folder = self.folder / "empty"
        folder.mkdir()
        done = subprocess.run(["panvo", "component", "show", "panvo_recorder"], cwd=folder, env=self.environment, capture_output=True, text=True,
                              timeout=LIMIT_S, check=True)
        self.assertIn("max_file_mb", done.stdout)
        self.assertEqual(list(folder.iterdir()), [])

    def test_its_service_answers_and_its_message_is_known(self):
        (self.folder / "alone.yaml").write_text(
            "launch:\n- node_container:\n    name: panvo\n    composable_node:\n"
            f"    - pkg: {NAME}\n      plugin: TripMeterComponent\n      name: {NAME}\n", encoding="utf-8")
        self.start("panvo", "run", "alone.yaml")

        def answer():
            done = subprocess.run(["panvo", "service", "call", f"/{NAME}/reset", "{distance_m: 5}"], cwd=self.folder, env=self.environment,
                                  capture_output=True, text=True, timeout=LIMIT_S, check=False)
            return done.stdout if done.returncode == 0 else None

        self.assertRegex(self.eventually(answer), r"previous_distance_m: 0(\.0)?\n")
        self.assertRegex(self.eventually(answer), r"previous_distance_m: 5(\.0)?\n")
        topics = self.eventually(lambda: (lambda said: said if f"/{NAME}/distance" in said else None)(self.run_command("panvo", "topic", "list", "-t")))
        self.assertIn(f"/{NAME}/distance [{NAME}_msgs/msg/Distance]", topics)

    def test_messages_are_echoed_recorded_checked_and_played(self):
        recording = pathlib.Path(self.environment.get("PANVO_DATA", ROOT.parent / "shared/data")) / "kitti_03"
        if not recording.is_dir():
            self.skipTest(f"no recording at {recording}; set PANVO_DATA to the folder that holds kitti_03")
        system = self.package / "config" / f"{NAME}.yaml"
        with_recorder = self.folder / "recorded.yaml"
        with_recorder.write_text(system.read_text(encoding="utf-8") +
                                 "    - pkg: panvo_recorder\n      plugin: RecorderComponent\n      name: recorder\n      param:\n"
                                 f"      - {{name: output, value: {self.folder}/bag}}\n      - {{name: topics, value: [/{NAME}/distance]}}\n",
                                 encoding="utf-8")
        self.run_command("panvo", "run", with_recorder, "--dataset", recording, "--out", "run")
        said = self.run_command("panvo", "bag", "check", "bag")
        self.assertRegex(said, rf"/{NAME}/distance +{NAME}_msgs/msg/Distance +99 readable, all decodable")
        self.start("panvo", "play", "bag", "--rate", "5", "--await", f"/{NAME}/distance")
        echoed = self.run_command("panvo", "topic", "echo", f"/{NAME}/distance", "--once", "--timeout", str(LIMIT_S))
        distance_m = float(re.search(r"^distance_m: (\S+)$", echoed, re.MULTILINE).group(1))
        self.assertGreaterEqual(distance_m, 0)
        self.assertLess(distance_m, 70, "kitti_03 is 58 m long")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--build")
    options, rest = parser.parse_known_args()
    OwnPackage.build = options.build
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)
