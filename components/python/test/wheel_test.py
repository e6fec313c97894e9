# SPDX-License-Identifier: Apache-2.0
"""make_wheel.py on a made-up installation: a wheel that pip's rules accept, and installations it refuses."""
import base64
import hashlib
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

import panvo

SCRIPT = pathlib.Path(__file__).resolve().parents[1] / "make_wheel.py"
VERSION = panvo.__version__


class Wheel(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.prefix = pathlib.Path(scratch.name) / "prefix"
        self.package = self.prefix / "lib/python3.11/site-packages/panvo"

    def install(self):
        """The module of the build folder, with panvo's libraries in the prefix as far as ldd finds them there."""
        built = pathlib.Path(panvo.__file__).parent
        self.package.mkdir(parents=True)
        for file in built.iterdir():
            if file.is_file():
                shutil.copy(file, self.package)
        described = self.prefix / "share/panvo_python"
        described.mkdir(parents=True)
        shutil.copy(SCRIPT.parent / "package.xml", described)

    def make(self):
        return subprocess.run([sys.executable, SCRIPT, self.prefix, "--out", self.prefix / "dist"], capture_output=True, text=True, timeout=120,
                              check=False)

    def test_of_libraries_elsewhere_is_refused(self):
        self.install()
        done = self.make()
        self.assertEqual(done.returncode, 1)
        self.assertIn("install to one prefix", done.stderr)

    def test_without_the_module_is_refused(self):
        done = self.make()
        self.assertEqual(done.returncode, 1)
        self.assertIn("no module _core", done.stderr)

    def test_holds_the_package_its_libraries_and_their_digests(self):
        self.install()
        sys.path.insert(0, str(SCRIPT.parent))
        self.addCleanup(sys.path.remove, str(SCRIPT.parent))
        import make_wheel
        contents = {"panvo/__init__.py": b"print('hello')\n", f"panvo-{VERSION}.dist-info/WHEEL": b"Wheel-Version: 1.0\n"}
        tag = make_wheel.tag_of(pathlib.Path("_core.cpython-311-x86_64-linux-gnu.so"))
        self.assertTrue(tag.startswith("cp311-cp311-linux_"), tag)
        wheel = self.prefix / f"panvo-{VERSION}-{tag}.whl"
        make_wheel.write_wheel(wheel, contents)
        first = wheel.read_bytes()
        make_wheel.write_wheel(wheel, contents)
        self.assertEqual(wheel.read_bytes(), first)
        with zipfile.ZipFile(wheel) as archive:
            names = archive.namelist()
            record = archive.read(f"panvo-{VERSION}.dist-info/RECORD").decode()
        self.assertEqual(names[-1], f"panvo-{VERSION}.dist-info/RECORD")
        digest = base64.urlsafe_b64encode(hashlib.sha256(contents["panvo/__init__.py"]).digest()).rstrip(b"=").decode()
        self.assertIn(f"panvo/__init__.py,sha256={digest},15\n", record)
        self.assertEqual(make_wheel.version_of(self.prefix), VERSION)


if __name__ == "__main__":
    unittest.main()
