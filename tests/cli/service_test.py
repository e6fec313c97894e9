# SPDX-License-Identifier: Apache-2.0
"""What `panvo run` tells systemd, on a socket like the one systemd gives to a service of Type=notify."""
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

PANVO_RUN, PLUGINS = sys.argv.pop(1), sys.argv.pop(1)
STEREO = pathlib.Path(__file__).resolve().parents[2] / "config" / "systems" / "stereo.yaml"  # waits for images


class Service(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.addCleanup(self.socket.close)
        self.socket.bind(str(self.folder / "notify"))
        self.socket.settimeout(60)

    def start(self, **environment):
        process = subprocess.Popen([PANVO_RUN, STEREO, "--local"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                   env={**os.environ, "PANVO_PLUGIN_PATH": PLUGINS, "NOTIFY_SOCKET": str(self.folder / "notify"), **environment})
        self.addCleanup(process.kill)
        return process

    def told(self):
        return self.socket.recv(1000).decode()

    def test_is_told_that_the_system_is_ready_alive_and_stopping(self):
        process = self.start(WATCHDOG_USEC="200000")
        self.assertEqual(self.told(), "READY=1")
        for _ in range(3):
            self.assertEqual(self.told(), "WATCHDOG=1")
        process.send_signal(signal.SIGTERM)
        last = self.told()
        while last == "WATCHDOG=1":
            last = self.told()
        self.assertEqual(last, "STOPPING=1")
        self.assertEqual(process.wait(timeout=60), 0)

    def test_is_not_told_that_it_is_alive_without_a_watchdog(self):
        process = self.start()
        self.assertEqual(self.told(), "READY=1")
        process.send_signal(signal.SIGTERM)
        self.assertEqual(self.told(), "STOPPING=1")
        self.assertEqual(process.wait(timeout=60), 0)


if __name__ == "__main__":
    unittest.main()
