# SPDX-License-Identifier: Apache-2.0
"""Unpacks zip and tar archives into a folder, and nothing outside it. A file gets its name when it is complete."""
import contextlib
import itertools
import pathlib
import shutil
import stat
import tarfile
import zipfile
import zlib

import catalogue

SUFFIXES = (".zip", ".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tbz2", ".tar.xz", ".txz")
RESERVE_BYTES = 256 << 20  # free space that is left on the disk
PEEKED = 2000  # members that are looked at to recognise an archive
DEEPEST = 2  # archives in archives: sequences in a bundle
JUNK = ("__MACOSX", ".DS_Store", "._")  # added by an operating system


class ArchiveError(Exception):
    """An archive that is damaged, not allowed or too large, with the reason."""


def is_archive(file):
    return file.is_file() and file.name.lower().endswith(SUFFIXES)


def stem(file):
    """Name without the suffix of the archive."""
    suffix = next(suffix for suffix in SUFFIXES if file.name.lower().endswith(suffix))
    return file.name[:-len(suffix)]


@contextlib.contextmanager
def reading(file):
    """Turns what goes wrong while an archive is read into an ArchiveError."""
    try:
        yield
    except (tarfile.TarError, zipfile.BadZipFile, EOFError, zlib.error) as error:
        raise ArchiveError(f"{file}: is damaged or cut off ({error}); download it again") from error
    except (NotImplementedError, RuntimeError) as error:  # an unknown compression, a password
        raise ArchiveError(f"{file}: cannot be unpacked: {error}") from error
    except OSError as error:
        raise ArchiveError(f"{error.filename or file}: {error.strerror or error}") from error


def data_set_of(file):
    """Key of the data set that an archive belongs to, or None."""
    with reading(file):
        if file.name.lower().endswith(".zip"):
            with zipfile.ZipFile(file) as archive:
                return first_key(archive.namelist())
        with tarfile.open(file) as archive:
            return first_key(member.name for member in archive)


def first_key(names):
    """Key of the first name that belongs to a data set, or None."""
    keys = (catalogue.of_member(name) for name in itertools.islice(names, PEEKED))
    return next((key for key in keys if key), None)


def unpack(file, folder, depth=1):
    """Unpacks an archive, and those in it, which are then removed. Returns the number of files."""
    with reading(file):
        files = unpack_zip(file, folder) if file.name.lower().endswith(".zip") else unpack_tar(file, folder)
    count = len(files)
    for inner in filter(is_archive, files if depth < DEEPEST else ()):
        # NAME/NAME.zip is unpacked into NAME, other/NAME.zip into other/NAME.
        count += unpack(inner, inner.parent if inner.parent.name == stem(inner) else inner.parent / stem(inner), depth + 1) - 1
        inner.unlink()
    return count


def unpack_zip(file, folder):
    """Returns the files that were written. Paths and space are checked before the first is."""
    with zipfile.ZipFile(file) as archive:
        members = [member for member in archive.infolist() if not member.is_dir() and not is_junk(member.filename)]
        for member in members:
            mode = member.external_attr >> 16
            if stat.S_IFMT(mode) not in (0, stat.S_IFREG):  # 0: written without file modes
                raise ArchiveError(f"{file}: '{member.filename}' is a link or a device; nothing was unpacked")
        targets = [destination(file, folder, member.filename) for member in members]
        require_space(file, folder, sum(member.file_size for member in members))
        for member, target in zip(members, targets):
            with archive.open(member) as source:
                write(source, target)
    return targets


def unpack_tar(file, folder):
    """Returns the files that were written. Paths and space are checked file by file: a compressed archive of many GB is read only once."""
    targets = []
    require_space(file, folder, file.stat().st_size)
    with tarfile.open(file) as archive:
        for member in archive:
            if member.isdir() or is_junk(member.name):
                continue
            if not member.isreg():
                raise ArchiveError(f"{file}: '{member.name}' is a link or a device; unpacking stopped")
            targets.append(destination(file, folder, member.name))
            require_space(file, folder, member.size)
            with archive.extractfile(member) as source:
                write(source, targets[-1])
    return targets


def is_junk(name):
    return any(part.startswith(JUNK) for part in pathlib.PurePosixPath(name).parts)


def destination(file, folder, name):
    """Where a member goes. Throws ArchiveError if that is outside the folder, also through a link that is there already."""
    path = pathlib.PurePosixPath(name)
    target = folder / path
    if not path.parts or not target.resolve().is_relative_to(folder.resolve()):
        raise ArchiveError(f"{file}: '{name}' leads out of the folder; the archive is not safe")
    return target


def require_space(file, folder, needed):
    free = shutil.disk_usage(next(parent for parent in (folder, *folder.absolute().parents) if parent.exists())).free
    if needed + RESERVE_BYTES > free:
        raise ArchiveError(f"{file}: needs {in_gb(needed)} in {folder}, which has {in_gb(max(0, free - RESERVE_BYTES))} free; "
                           "make room, or choose another folder with --out")


def write(source, target):
    target.parent.mkdir(parents=True, exist_ok=True)
    unfinished = target.with_name(target.name + ".part")
    with open(unfinished, "wb") as stream:
        shutil.copyfileobj(source, stream, 1 << 20)
    unfinished.replace(target)


def in_gb(count):
    return f"{count / 1e9:.2f} GB"
