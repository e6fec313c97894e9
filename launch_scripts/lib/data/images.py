# SPDX-License-Identifier: Apache-2.0
"""Finds cut-off images by the end that their format requires, and reads image sizes, without decoding."""
import os
import re
import struct

SUFFIXES = {".png", ".jpg", ".jpeg", ".pgm", ".ppm", ".bmp", ".tif", ".tiff"}  # those of the data set player
PNG_BEGIN = b"\x89PNG\r\n\x1a\n"
PNG_END = b"\x00\x00\x00\x00IEND\xaeB`\x82"
JPEG_BEGIN = b"\xff\xd8"
JPEG_END = b"\xff\xd9"
BEGIN_BYTES, END_BYTES = 65536, 4096


def images_in(folder):
    """Names of the images in a folder, sorted."""
    return sorted(entry.name for entry in os.scandir(folder) if os.path.splitext(entry.name)[1].lower() in SUFFIXES)


def problem_of(file):
    """What is wrong with an image file, or None."""
    try:
        size = os.path.getsize(file)
        with open(file, "rb") as stream:
            begin = stream.read(BEGIN_BYTES)
            stream.seek(max(0, size - END_BYTES))
            end = stream.read()
    except OSError as error:
        return error.strerror
    if size == 0:
        return "is empty"
    if begin.startswith(PNG_BEGIN):
        return None if end.endswith(PNG_END) else "is cut off"
    if begin.startswith(JPEG_BEGIN):
        # Cameras may append padding; the compressed data itself cannot contain the marker.
        return None if JPEG_END in end or has_marker(file) else "is cut off"
    if begin.startswith((b"P5", b"P6")):
        return None if size >= netpbm_bytes(begin) else "is cut off"
    if begin.startswith(b"BM") and len(begin) >= 6:
        return None if size >= struct.unpack_from("<I", begin, 2)[0] else "is cut off"
    if begin.startswith((b"II*\x00", b"MM\x00*")) and len(begin) >= 8:
        return None if struct.unpack_from("<I" if begin[:1] == b"I" else ">I", begin, 4)[0] < size else "is cut off"
    return "is not an image"


def has_marker(file):
    with open(file, "rb") as stream:
        return JPEG_END in stream.read()[2:]


def netpbm_header(begin):
    """(width, height, largest value, bytes of the header) of a binary PGM or PPM, or None."""
    found = re.match(rb"P[56](?:\s+|#[^\n]*\n)+(\d+)(?:\s+|#[^\n]*\n)+(\d+)(?:\s+|#[^\n]*\n)+(\d+)\s", begin)
    return (*map(int, found.groups()), found.end()) if found else None


def netpbm_bytes(begin):
    """Size of a complete file; larger than any file if the header is not complete."""
    header = netpbm_header(begin)
    if not header:
        return float("inf")
    width, height, largest, offset = header
    return offset + width * height * (3 if begin.startswith(b"P6") else 1) * (2 if largest > 255 else 1)


def size_of(file):
    """(width, height) in pixels; None for formats other than PNG, JPEG, PGM and PPM, and for damaged files."""
    with open(file, "rb") as stream:
        begin = stream.read(BEGIN_BYTES)
    if begin.startswith(PNG_BEGIN) and len(begin) >= 24:
        return struct.unpack_from(">II", begin, 16)
    if begin.startswith(JPEG_BEGIN):
        return jpeg_size(begin)
    header = netpbm_header(begin)
    return header[:2] if header else None


def jpeg_size(begin):
    """Size in the first frame header (SOF0 to SOF15 without DHT, JPG and DAC)."""
    position = 2
    while position + 9 <= len(begin) and begin[position] == 0xFF:
        marker, length = begin[position + 1], struct.unpack_from(">H", begin, position + 2)[0]
        if 0xC0 <= marker <= 0xCF and marker not in (0xC4, 0xC8, 0xCC):
            height, width = struct.unpack_from(">HH", begin, position + 5)
            return width, height
        position += 2 + length
    return None
