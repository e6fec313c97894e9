# SPDX-License-Identifier: Apache-2.0
"""Small recordings in the layouts of public data sets, as path -> content, and archives of them."""
import io
import struct
import tarfile
import zipfile
import zlib


def png(width=8, height=6):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes((width + 1) * height))) + chunk(b"IEND", b"")


def jpeg(width=8, height=6):
    return b"\xff\xd8\xff\xe0\x00\x04ab\xff\xc0\x00\x0b\x08" + struct.pack(">HH", height, width) + b"\x01\x01\x11\x00rest\xff\xd9"


def kitti(count=3):
    """path -> content of one sequence, in the three archives that it is published in."""
    images_of = {f"dataset/sequences/03/image_{eye}/{i:06}.png": png() for eye in (0, 1) for i in range(count)}
    pose = " ".join(map(str, (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)))
    calibration = "P0: 700 0 4 0 0 700 3 0 0 0 1 0\nP1: 700 0 4 -350 0 700 3 0 0 0 1 0\n"
    times = "".join(f"{0.1 * i:e}\n" for i in range(count))
    return (images_of, {"dataset/sequences/03/calib.txt": calibration, "dataset/sequences/03/times.txt": times},
            {"dataset/poses/03.txt": f"{pose}\n" * count})


SENSOR = """sensor_type: camera
T_BS:
  cols: 4
  rows: 4
  data: [1.0, 0.0, 0.0, {x},
         0.0, 1.0, 0.0, 0.0,
         0.0, 0.0, 1.0, 0.0,
         0.0, 0.0, 0.0, 1.0]
rate_hz: 20
resolution: [8, 6]
camera_model: pinhole
intrinsics: [458.6, 457.2, 4.0, 3.0] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.28, 0.07, 0.0, 0.0]
"""


def euroc(count=3, panorama=False):
    files = {}
    for camera in ("cam0", "cam1", *(("cam2",) if panorama else ())):
        stamps = [10**18 + i * 50_000_000 for i in range(count)]
        files[f"mav0/{camera}/data.csv"] = "#timestamp [ns],filename\r\n" + "".join(f"{stamp},{stamp}.png\r\n" for stamp in stamps)
        files.update({f"mav0/{camera}/data/{stamp}.png": png() for stamp in stamps})
        files[f"mav0/{camera}/sensor.yaml"] = SENSOR.replace("{x}", "0.1" if camera == "cam1" else "0.0")
    if panorama:
        files["mav0/cam2/sensor.yaml"] = files["mav0/cam2/sensor.yaml"].replace("pinhole", "equirectangular")
    poses = "".join(f"{10**18 + i * 10**8},0,0,0,1,0,0,0,0,0,0\n" for i in range(count))
    files["mav0/state_groundtruth_estimate0/data.csv"] = "#t\n" + poses
    return files


def as_bytes(content):
    return content if isinstance(content, bytes) else content.encode()


def write_zip(file, members):
    with zipfile.ZipFile(file, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, as_bytes(content))


def write_tar(file, members, links=()):
    with tarfile.open(file, "w:gz" if file.name.endswith("gz") else "w") as archive:
        for name, content in members.items():
            member = tarfile.TarInfo(name)
            member.size = len(as_bytes(content))
            archive.addfile(member, io.BytesIO(as_bytes(content)))
        for name, target in links:
            member = tarfile.TarInfo(name)
            member.type, member.linkname = tarfile.SYMTYPE, target
            archive.addfile(member)
