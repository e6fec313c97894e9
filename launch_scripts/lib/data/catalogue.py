# SPDX-License-Identifier: Apache-2.0
"""Public recordings that suit panvo: sensors, source, licence, size, and the command that plays them."""
import dataclasses
import re
import textwrap


@dataclasses.dataclass(frozen=True)
class DataSet:
    """One public data set. `run` is empty if panvo cannot read it; `missing` then says what a conversion has to make."""
    name: str
    sensors: str
    truth: str
    source: str
    licence: str
    size: str
    member: re.Pattern  # matches the path of a file in its archives
    files: str = ""
    run: str = ""
    missing: str = ""


WIDTH = 120  # of the printed catalogue


def path(pattern):
    """Matches from the begin of any part of a path."""
    return re.compile(r"(?:^|/)" + pattern)


DATA_SETS = {
    "kitti": DataSet(
        name="KITTI odometry",
        sensors="rectified stereo pair, grey or colour, 10 Hz, on a car; no panorama",
        truth="poses of sequences 00 to 10",
        source="https://www.cvlibs.net/datasets/kitti/eval_odometry.php (needs a free account)",
        files="data_odometry_gray.zip, data_odometry_calib.zip, data_odometry_poses.zip: unpack them together, in this order",
        licence="CC BY-NC-SA 3.0",
        size="22 GB (grey images of all sequences)",
        member=path(r"(?:sequences/\d\d/(?:image_[0-3]/|calib\.txt|times\.txt)|poses/\d\d\.txt$)"),
        run="panvo run stereo --dataset dataset/sequences/03 --out runs/kitti_03"),
    "euroc": DataSet(
        name="EuRoC MAV",
        sensors="stereo pair 752 x 480 px, grey, 20 Hz, and IMU on a multicopter; no panorama",
        truth="poses (state_groundtruth_estimate0)",
        source="https://doi.org/10.3929/ethz-b-000690084",
        files="machine_hall.zip and those of the Vicon rooms; each holds one archive per sequence, which are unpacked too",
        licence="in copyright, non-commercial use permitted",
        size="13 GB (machine_hall.zip)",
        member=path(r"(?:mav0/|cam[012]/(?:data\.csv|sensor\.yaml)|(?:MH_0\d|V[12]_0\d)_\w+\.zip$)"),
        run="panvo run stereo --dataset MH_01_easy --out runs/MH_01_easy"),
    "tum_vi": DataSet(
        name="TUM VI",
        sensors="stereo pair of fisheye cameras, grey, 20 Hz, and IMU, hand-held; no panorama",
        truth="poses (mocap0): whole room sequences, begin and end of the others",
        source="https://cvg.cit.tum.de/data/datasets/visual-inertial-dataset",
        files="dataset-NAME_512_16.tar, in the EuRoC format",
        licence="CC BY 4.0",
        size="some GB per sequence of 512 x 512 px",
        member=path(r"dataset-[a-z]+\d+_\d+_\d+/"),
        missing="mav0/cam0/sensor.yaml and mav0/cam1/sensor.yaml (their values are in dso/camchain.yaml, lens model equidistant)"),
    "4seasons": DataSet(
        name="4Seasons",
        sensors="stereo pair, grey, undistorted 800 x 400 px, 30 Hz, IMU and RTK GNSS on a car, the same routes in all seasons; "
                "no panorama",
        truth="poses of keyframes, fused with GNSS (GNSSPoses.txt)",
        source="https://cvg.cit.tum.de/data/datasets/4seasons-dataset",
        files="recording_*_stereo_images_undistorted.zip, recording_*_reference_poses.zip, calibration.zip",
        licence="CC BY-NC-SA 4.0",
        size="some GB per recording",
        member=path(r"(?:recording_\d{4}-\d\d-\d\d_|undistorted_images/cam[01]/|distorted_images/cam[01]/|undistorted_calib_)"),
        missing="the EuRoC layout: data.csv from times.txt, sensor.yaml from undistorted_calib_0.txt, _1.txt and _stereo.txt; "
                "GNSSPoses.txt as ground truth, with its scale and Transformations.txt"),
    "nclt": DataSet(
        name="NCLT",
        sensors="Ladybug3 (five heads around, one upwards, 5 Hz), lidar, odometry, IMU and GPS on a Segway, 27 sessions; no stereo pair",
        truth="poses (groundtruth_DATE.csv)",
        source="http://robots.engin.umich.edu/nclt/",
        files="DATE_lb3.tar.gz, groundtruth_DATE.csv",
        licence="Open Database License, contents: Database Contents License",
        size="tens of GB per session",
        member=path(r"(?:\d{4}-\d\d-\d\d/)?lb3/Cam\d/"),
        missing="a reader of lb3/CamN/TIME.tiff that publishes panorama/head_N/image_raw for the stitcher (rig ladybug3), and another "
                "source of odometry, because there is no stereo pair"),
    "kitti_360": DataSet(
        name="KITTI-360",
        sensors="stereo pair to the front and two 180 degree fisheye cameras to the sides, which together see all around, on a car",
        truth="poses (poses.txt, cam0_to_world.txt)",
        source="https://www.cvlibs.net/datasets/kitti-360/ (needs a free account)",
        files="perspective and fisheye images, calibrations, vehicle poses",
        licence="CC BY-NC-SA 3.0",
        size="hundreds of GB",
        member=path(r"(?:2013_05_28_drive_\d{4}_sync/|data_2d_raw/)"),
        missing="the EuRoC layout: cam0 and cam1 from image_00/data_rect and image_01/data_rect with calibration/perspective.txt, cam2 "
                "from panoramas stitched of image_02/data_rgb and image_03/data_rgb, ground truth from cam0_to_world.txt"),
    "robotcar": DataSet(
        name="Oxford RobotCar",
        sensors="Bumblebee XB3 stereo camera 16 Hz, three 180 degree fisheye cameras (left, right, rear) 11 Hz, lidar, GPS and INS on a "
                "car, one route through a year",
        truth="INS; RTK poses for a part",
        source="https://robotcar-dataset.robots.ox.ac.uk/ (needs a free account)",
        files="TRAVERSAL_stereo_left_NN.tar, _stereo_right_NN.tar, _mono_left_NN.tar, _mono_right_NN.tar, _mono_rear_NN.tar",
        licence="CC BY-NC-SA 4.0",
        size="hundreds of GB per traversal",
        member=path(r"\d{4}(?:-\d\d){5}/(?:stereo|mono_\w+)/"),
        missing="the EuRoC layout: images without Bayer pattern and distortion, cam2 from panoramas stitched of the fisheye images, "
                "ground truth from the INS"),
    "folders": DataSet(
        name="left and right images",
        sensors="a stereo pair of your own",
        truth="",
        source="",
        licence="",
        size="",
        member=path(r"(?:left|right)/[^/]+\.(?:png|jpe?g|pgm|ppm|bmp|tiff?)$"),
        run="panvo run stereo --dataset DIR --out runs/mine"),
}


def of_member(name):
    """Key of the data set whose archives hold a file of this name, or None."""
    # Those that panvo reads are the last, because others contain parts of their layouts.
    keys = sorted(DATA_SETS, key=lambda key: not DATA_SETS[key].missing)
    return next((key for key in keys if DATA_SETS[key].member.search(name)), None)


def conversion(key):
    """Why panvo cannot read this data set, or an empty string."""
    data_set = DATA_SETS[key]
    return f"{data_set.name} is not readable yet and needs conversion. Missing: {data_set.missing}" if data_set.missing else ""


def described():
    """The public data sets as text."""
    lines = []
    for data_set in DATA_SETS.values():
        if not data_set.source:
            continue
        lines.append(data_set.name)
        run = data_set.run or f"not readable yet: needs conversion. Missing: {data_set.missing}"
        for label, text in (("sensors", data_set.sensors), ("truth", data_set.truth), ("from", data_set.source), ("files", data_set.files),
                            ("licence", data_set.licence), ("size", data_set.size), ("run", run)):
            if text:
                lines.append(textwrap.fill(text, WIDTH, initial_indent=f"  {label:8} ", subsequent_indent=" " * 11, break_on_hyphens=False))
        lines.append("")
    return "\n".join(lines)
