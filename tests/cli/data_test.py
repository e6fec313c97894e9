# SPDX-License-Identifier: Apache-2.0
"""`panvo data`: the catalogue, made-up archives of public data sets, and recordings with one thing wrong."""
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

from made_up_recordings import SENSOR, as_bytes, euroc, jpeg, kitti, png, write_tar, write_zip

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "launch_scripts" / "lib" / "data"))
import archives  # noqa: E402
import images  # noqa: E402


class DataTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name, "down loads")
        self.folder.mkdir()

    def panvo(self, *arguments):
        command = [ROOT / "launch_scripts" / "panvo", "data", *map(str, arguments)]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=60, check=False)

    def write(self, members):
        for name, content in members.items():
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_bytes(as_bytes(content))

    def assert_says(self, done, status, *words):
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        for text in words:
            self.assertIn(text, done.stdout + done.stderr)

    def files(self):
        return {str(path.relative_to(self.folder)) for path in self.folder.rglob("*") if path.is_file()}


class Catalogue(DataTest):
    def test_names_each_data_set_with_source_licence_and_command(self):
        done = self.panvo()
        self.assert_says(done, 0)
        public = done.stdout.split("\n\n")[:-2]
        self.assertEqual(len(public), 7)
        for entry in public:
            for label in ("sensors", "truth", "from     http", "licence", "size", "run"):
                self.assertIn(f"\n  {label}", entry)

    def test_says_what_cannot_be_read(self):
        self.assertEqual(self.panvo().stdout.count("not readable yet: needs conversion. Missing:"), 5)


class Prepare(DataTest):
    def test_kitti_of_three_archives(self):
        names = ("data_odometry_gray.zip", "data_odometry_calib.zip", "data_odometry_poses.zip")
        for name, members in zip(names, kitti()):
            write_zip(self.folder / name, members)
        done = self.panvo("prepare", *names, "--out", "kitti")
        self.assert_says(done, 0, "stereo: 3 pairs, 8 x 6 px", "times: 0.2 s, 10.0 Hz", "baseline 0.500 m", "ground truth: 3 poses",
                         "run: panvo run stereo --dataset kitti/dataset/sequences/03 --out runs/03",
                         "run: panvo evaluate runs/03 kitti/dataset/sequences/03")
        self.assertIn("kitti/dataset/sequences/03/image_1/000002.png", self.files())

    def test_a_folder_of_archives_and_again_into_the_same_folder(self):
        for name, members in zip("abc", kitti()):
            write_zip(self.folder / f"{name}.zip", members)
        self.assert_says(self.panvo("prepare", ".", "--out", "kitti"), 0, "unpacking c.zip into kitti", "ground truth: 3 poses")
        self.assert_says(self.panvo("prepare", "c.zip", "--out", "kitti"), 0, "ground truth: 3 poses")

    def test_the_archives_within_a_bundle_of_euroc(self):
        for name in ("MH_01_easy", "MH_02_easy"):
            write_zip(self.folder / f"{name}.zip", {**euroc(), "__MACOSX/mav0/._x": "junk"})
        write_zip(self.folder / "machine_hall.zip", {f"machine_hall/{name}/{name}.zip": (self.folder / f"{name}.zip").read_bytes()
                                                     for name in ("MH_01_easy", "MH_02_easy")})
        done = self.panvo("prepare", "machine_hall.zip")
        self.assert_says(done, 0, "cam0: 3 images, 8 x 6 px, 0.1 s, 20.0 Hz", "ground truth: 3 poses", "2 of 2 recordings can be played",
                         "panvo run stereo --dataset machine_hall/machine_hall/MH_02_easy --out runs/MH_02_easy")
        self.assertNotIn("machine_hall/machine_hall/MH_01_easy/MH_01_easy.zip", self.files(), "unpacked, so removed")
        self.assertTrue((self.folder / "machine_hall.zip").exists())
        self.assertFalse([name for name in self.files() if "MACOSX" in name])

    def test_a_compressed_tar_file_with_panoramas(self):
        write_tar(self.folder / "drive.tar.gz", euroc(panorama=True))
        done = self.panvo("prepare", "drive.tar.gz")
        self.assert_says(done, 0, "cam2: 3 images", "panvo run enhanced_vo --dataset drive --out runs/drive")

    def test_what_needs_conversion_is_said_before_anything_is_unpacked(self):
        write_tar(self.folder / "dataset-room1_512_16.tar", {"dataset-room1_512_16/mav0/cam0/data.csv": "#\n"})
        write_zip(self.folder / "recording.zip", {"recording_2020-10-07_14-47-51/undistorted_images/cam0/1.png": png()})
        write_tar(self.folder / "2012-01-08_lb3.tar.gz", {"2012-01-08/lb3/Cam0/1.tiff": b"II*\x00"})
        write_tar(self.folder / "left.tar", {"2014-05-06-12-54-54/stereo/left/1.png": png()})
        before = self.files()
        for archive, name in (("dataset-room1_512_16.tar", "TUM VI"), ("recording.zip", "4Seasons"), ("2012-01-08_lb3.tar.gz", "NCLT"),
                              ("left.tar", "Oxford RobotCar")):
            with self.subTest(name):
                self.assert_says(self.panvo("prepare", archive), 1, f"{name} is not readable yet and needs conversion. Missing: ",
                                 "Nothing was unpacked")
        self.assertEqual(self.files(), before)

    def test_an_archive_of_something_else(self):
        write_zip(self.folder / "holiday.zip", {"beach/1.png": png()})
        self.assert_says(self.panvo("prepare", "holiday.zip"), 1, "holds no recording of a known layout")
        self.write({"notes.txt": "x"})
        self.assert_says(self.panvo("prepare", "notes.txt"), 2, "is neither a folder nor an archive")
        self.assert_says(self.panvo("prepare", "nothing.zip"), 2, "'nothing.zip' not found")

    def test_paths_and_links_that_lead_out_of_the_folder(self):
        write_zip(self.folder / "up.zip", {**euroc(), "../outside": "x"})
        write_zip(self.folder / "root.zip", {**euroc(), str(self.folder / "outside"): "x"})
        write_tar(self.folder / "up.tar", {**euroc(), "mav0/../../outside": "x"})
        write_tar(self.folder / "link.tar", euroc(), links=[("mav0/link", str(self.folder))])
        for name in ("up.zip", "root.zip", "up.tar", "link.tar"):
            with self.subTest(name):
                words = "is a link or a device" if name == "link.tar" else "leads out of the folder"
                self.assert_says(self.panvo("prepare", name, "--out", f"out of {name}"), 1, words)
        self.assertFalse((self.folder / "outside").exists())
        self.assertEqual(self.files() & {"out of up.zip/mav0/cam0/data.csv"}, set(), "zip: checked before the first file is written")

    def test_a_link_in_the_folder_is_not_followed_out_of_it(self):
        write_zip(self.folder / "v.zip", euroc())
        self.assert_says(self.panvo("prepare", "v.zip"), 0)
        shutil.rmtree(self.folder / "v/mav0")
        (self.folder / "elsewhere").mkdir()
        (self.folder / "v/mav0").symlink_to(self.folder / "elsewhere")
        self.assert_says(self.panvo("prepare", "v.zip"), 1, "leads out of the folder")
        self.assertEqual(list((self.folder / "elsewhere").iterdir()), [])

    def test_archives_that_were_cut_off(self):
        write_zip(self.folder / "v.zip", euroc())
        write_tar(self.folder / "v.tar.gz", {**euroc(), "mav0/noise": os.urandom(100_000)})
        for name, rest in (("v.zip", 500), ("v.tar.gz", 50_000)):
            with self.subTest(name):
                with open(self.folder / name, "r+b") as archive:
                    archive.truncate((self.folder / name).stat().st_size - rest)
                done = self.panvo("prepare", name, "--out", f"out of {name}")
                self.assert_says(done, 1, f"{name}: is damaged or cut off", "download it again")
        self.assertFalse([name for name in self.files() if name.endswith("noise")], "no file that is not complete")

    def test_a_folder_of_somebody_else_is_left_alone(self):
        write_zip(self.folder / "v.zip", euroc())
        self.write({"mine/precious": "x"})
        self.assert_says(self.panvo("prepare", "v.zip", "--out", "mine"), 2, "was not made by `panvo data prepare`")
        self.assertEqual(self.files(), {"v.zip", "mine/precious"})

    def test_too_little_space(self):
        write_zip(self.folder / "v.zip", euroc())
        write_tar(self.folder / "v.tar", euroc())
        usage = shutil.disk_usage(self.folder)._replace(free=archives.RESERVE_BYTES + 100)
        for name in ("v.zip", "v.tar"):
            with self.subTest(name), unittest.mock.patch("shutil.disk_usage", return_value=usage):
                with self.assertRaisesRegex(archives.ArchiveError, "has 0.00 GB free; make room"):
                    archives.unpack(self.folder / name, self.folder / "out")
        self.assertFalse((self.folder / "out").exists())


class Check(DataTest):
    def check(self, members, changes=None, folder="."):
        self.write({**members, **(changes or {})})
        return self.panvo("check", folder)

    def kitti(self, changes=None, without=()):
        members = {name: content for part in kitti() for name, content in part.items()}
        sequence = "dataset/sequences/03/"
        members.update({sequence + name: content for name, content in (changes or {}).items()})
        return self.check({name: content for name, content in members.items() if name.removeprefix(sequence) not in without})

    def euroc(self, changes=None, without=()):
        members = {**euroc(), **(changes or {})}
        return self.check({name: content for name, content in members.items() if name not in without})

    def test_images_of_kitti(self):
        self.assert_says(self.kitti(without=["image_1/000001.png"]), 1, "PROBLEM: images of image_0 without partner in image_1: 000001.png")
        self.assert_says(self.kitti({"image_1/000001.png": png()[:-1]}), 1, "PROBLEM: image_1: damaged images: 000001.png is cut off")
        self.assert_says(self.kitti({"image_1/000001.png": b""}), 1, "000001.png is empty")
        wider = {f"image_1/{i:06}.png": png(9) for i in range(3)}
        self.assert_says(self.kitti(wider), 1, "the images differ in size: 8 x 6 px and 9 x 6 px")

    def test_times_of_kitti(self):
        self.assert_says(self.kitti({"times.txt": "0\n0.1\n"}), 1, "times.txt has 2 times, but the last image is number 2")
        self.assert_says(self.kitti({"times.txt": "0\n0.1\n0.1\n"}), 1, "times.txt:3: '0.1' is not a time in seconds after the previous")

    def test_calibration_of_kitti(self):
        self.assert_says(self.kitti({"calib.txt": "P0: 700 0 4 0 0 700 3 0 0 0 1 0\n"}), 1, "calib.txt: no line 'P1:' with 12 numbers")
        self.assert_says(self.kitti({"calib.txt": "P0: 7 0 4 -3 0 7 3 0 0 0 1 0\nP1: 7 0 4 0 0 7 3 0 0 0 1 0\n"}), 1, "may be exchanged")

    def test_what_kitti_can_do_without(self):
        self.assert_says(self.kitti(without=["times.txt"]), 0, "note: no times.txt: 10 Hz is assumed")
        self.write({"dataset/poses/03.txt": "1 0 0 0 0 1 0 0 0 0 1 0\n"})
        self.assert_says(self.panvo("check", "dataset"), 0, "note: 2 pairs have no ground truth")
        (self.folder / "dataset/poses/03.txt").unlink()
        done = self.panvo("check", "dataset")
        self.assert_says(done, 0, "note: no ground truth")
        self.assertNotIn("panvo evaluate", done.stdout)
        self.write({"dataset/sequences/poses/03.txt": "1 0 0 0 0 1 0 0 0 0 1 0\n"})
        self.assert_says(self.panvo("check", "dataset"), 0, "ground truth: 1 poses", "run: panvo evaluate runs/03 dataset/sequences/03")

    def test_images_of_euroc(self):
        first = f"{10**18}.png"
        self.assert_says(self.euroc({"mav0/cam0/data/extra.png": png()}), 0, "note: 1 images of cam0/data are not in data.csv")
        self.assert_says(self.euroc({f"mav0/cam0/data/{first}": png()[:50]}), 1, f"mav0/cam0/data: damaged images: {first} is cut off")
        (self.folder / "mav0/cam0/data" / first).unlink()
        self.assert_says(self.panvo("check", "."), 1, f"mav0/cam0/data: missing images: {first}")

    def test_lists_of_euroc(self):
        name = "mav0/cam1/data.csv"
        self.assert_says(self.euroc({name: f"{10**18},{10**18}.png\n"}), 0, "note: 2 images of cam0 and cam1 have no partner")
        self.assert_says(self.euroc({name: "#t\n5,a.png\n5,b.png\n"}), 1, "cam1/data.csv:3: is not 'stamp in ns, file'")

    def test_calibration_of_euroc(self):
        name = "mav0/cam1/sensor.yaml"
        of_other_size = SENSOR.replace("[8, 6]", "[752, 480]")
        self.assert_says(self.euroc({name: of_other_size}), 1, "calibration is for 752 x 480 px, the images have 8 x 6 px")
        self.assert_says(self.euroc({name: SENSOR.replace("intrinsics", "intrinsic")}), 1, "cam1/sensor.yaml: no numbers of: intrinsics")
        self.assert_says(self.euroc({name: SENSOR.replace("pinhole", "omni")}), 1, "camera_model is omni, must be pinhole")
        (self.folder / name).unlink()
        self.assert_says(self.panvo("check", "."), 1, "cam1/sensor.yaml is missing")

    def test_ground_truth_of_euroc(self):
        name = "mav0/state_groundtruth_estimate0/data.csv"
        self.assert_says(self.euroc({name: "5,0,0,0,1,0,0,0\n6,0,0,0,1,0,0,0\n"}), 1, "covers none of the images: it is of another time")
        self.assert_says(self.euroc({name: f"{10**18},0,0,0,1,0,0,0\n"}), 0, "note: 2 of 3 images are before or after the ground truth")
        self.assert_says(self.euroc({name: f"{10**18},0,0,0,1,0,0\n"}), 1, "data.csv:1: is not 'stamp in ns, position, quaternion'")

    def test_ground_truth_of_euroc_from_motion_capture(self):
        poses = "".join(f"{10**18 + i * 10**8},0,0,0,1,0,0,0\n" for i in range(3))
        for system in ("vicon0", "mocap0"):
            with self.subTest(system):
                self.euroc({f"mav0/{system}/data.csv": poses})
                (self.folder / "mav0/state_groundtruth_estimate0/data.csv").unlink()
                self.assert_says(self.panvo("check", "."), 0, "ground truth: 3 poses, 0.2 s", "run: panvo evaluate")
                shutil.rmtree(self.folder / "mav0")

    def test_left_and_right_folders(self):
        members = {f"pair/{eye}/{eye}{i}.jpg": jpeg() for eye in ("left", "right") for i in range(2)}
        self.assert_says(self.check(members), 1, "there is no calibration: stereo_params.xml, or left.yaml and right.yaml")
        self.assert_says(self.check({"pair/stereo.yaml": "%YAML:1.0\n"}), 0, "stereo: 2 pairs, 8 x 6 px", "--dataset pair")

    def test_layouts_that_need_conversion(self):
        for path, name in (("a/mav0/cam0/data.csv", "TUM VI"), ("b/undistorted_images/cam0/1.png", "4Seasons"),
                           ("c/lb3/Cam0/1.tiff", "NCLT"), ("d/image_00/data_rect/1.png", "KITTI-360"),
                           ("e/stereo/centre/1.png", "Oxford RobotCar")):
            self.write({path: "x", "a/mav0/mocap0/data.csv": "x"})
            with self.subTest(name):
                self.assert_says(self.panvo("check", path[0]), 1, f"{name} is not readable yet and needs conversion")

    def test_nothing(self):
        self.assert_says(self.panvo("check", "."), 1, "holds no recording of a known layout; looked for EuRoC/ASL")
        self.assert_says(self.panvo("check", "nowhere"), 2, "folder 'nowhere' not found")


class Images(DataTest):
    def test_are_sound_or_cut_off(self):
        whole = {"a.png": png(), "a.jpg": jpeg() + bytes(5000), "a.pgm": b"P5\n# comment\n8 6\n255\n" + bytes(48),
                 "a.ppm": b"P6 8 6 65535\n" + bytes(288), "a.bmp": b"BM" + struct.pack("<I", 60) + bytes(54),
                 "a.tif": b"II*\x00" + struct.pack("<I", 50) + bytes(52)}
        cut = {"a.png": 1, "a.jpg": 5001, "a.pgm": 1, "a.ppm": 1, "a.bmp": 1, "a.tif": 20}
        for name, content in whole.items():
            with self.subTest(name):
                self.write({name: content, f"cut.{name}": content[:-cut[name]]})
                self.assertIsNone(images.problem_of(self.folder / name))
                self.assertEqual(images.problem_of(self.folder / f"cut.{name}"), "is cut off")
        self.assertEqual({images.size_of(self.folder / name) for name in ("a.png", "a.jpg", "a.pgm", "a.ppm")}, {(8, 6)})
        self.write({"page.png": "<html>not found</html>"})
        self.assertEqual(images.problem_of(self.folder / "page.png"), "is not an image")


if __name__ == "__main__":
    unittest.main()
