# SPDX-License-Identifier: Apache-2.0
"""Runs a command in QEMU under Debian's kernel, with the kernel's simulated cameras and USB.

    virtual_machine.py check                         reports missing requirements; prepares the kernel if needed
    virtual_machine.py run [--limit S] FOLDER WORDS  runs the command WORDS with FOLDER as /exchange; returns its exit status, 124 on timeout

The command sees all files of this machine. Its changes are discarded, except in /exchange. The kernel is downloaded once with apt-get (70 MB); the
parts needed (about 70 MB) are kept in the user's cache. Module arguments: --module vivid=n_devs=1;node_types=1; to skip a module: --module vivid=none
"""
import argparse
import contextlib
import fcntl
import gzip
import lzma
import os
import pathlib
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

TOOLS = {"qemu-system-x86_64": "qemu-system-x86", "busybox": "busybox-static", "modprobe": "kmod", "depmod": "kmod", "cpio": "cpio",
         "apt-get": "apt", "dpkg-deb": "dpkg", "tar": "tar"}
MODULES = ["virtio_pci", "9pnet_virtio", "9p", "overlay", "vivid", "uvcvideo", "vhci-hcd"]
WANTED = ["./boot/vmlinuz*", "./lib/modules/*/modules.*"] + [f"./lib/modules/*/kernel/{folder}/*" for folder in (
    "drivers/media", "drivers/virtio", "drivers/usb", "drivers/char", "net/9p", "fs", "lib")]
DOWNLOAD_S, UNPACK_S = 150, 100
TOO_LONG = 124
# USB autosuspend is not under test; with it, a camera answers late after it was closed.
ALWAYS = ["module.usbcore=autosuspend=-1"]


class CannotBe(Exception):
    """A virtual machine cannot run here; the message names cause and remedy."""


def find_tool(name):
    return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


def require_tools():
    if platform.machine() != "x86_64":
        raise CannotBe(f"the kernel of the virtual machine needs x86_64, this is {platform.machine()}")
    missing = sorted({package for tool, package in TOOLS.items() if not find_tool(tool)})
    if missing:
        raise CannotBe("apt-get install --no-install-recommends " + " ".join(missing))


def output_of(words, **options):
    """Output of a tool; raises CannotBe with its last line if it fails."""
    environment = dict(os.environ, PATH=os.environ.get("PATH", "") + ":/usr/sbin:/sbin", LC_ALL="C")
    try:
        done = subprocess.run(words, capture_output=True, text=True, env=environment, check=False, **options)
    except subprocess.TimeoutExpired as error:
        raise CannotBe(f"{words[0]} took more than {error.timeout:.0f} s, maybe because of a slow download; try again") from error
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines()
        raise CannotBe(f"{shlex.join(words[:3])} failed: {said[-1] if said else 'no message'}")
    return done.stdout


def kernel_package():
    for line in output_of(["apt-cache", "depends", "linux-image-amd64"], timeout=60).splitlines():
        if "Depends: linux-image-" in line:
            return line.split()[-1]
    raise CannotBe("apt does not find linux-image-amd64 (Debian's kernel): run apt-get update")


def unpacked_kernel(compressed):
    """The ELF file in a vmlinuz, because an emulated processor would need seconds to unpack it at each start."""
    start = compressed.find(b"\xfd7zXZ\0")
    if start < 0:
        raise CannotBe("Debian's kernel is no longer compressed with xz; tests/virtual_machine must be adapted")
    return lzma.LZMADecompressor().decompress(compressed[start:])


def module_files(root, version):
    """The modules and their dependencies in load order."""
    files = []
    for module in MODULES:
        said = output_of(["modprobe", "-d", str(root), "-S", version, "--show-depends", module], timeout=60)
        for line in said.splitlines():
            if line.startswith("insmod ") and (file := pathlib.Path(line.split()[1])) not in files:
                files.append(file)
    return files


def write_first_files(work, version, target):
    root = work / "initrd"
    for folder in ("bin", "proc", "sys", "dev", "modules"):
        (root / folder).mkdir(parents=True)
    shutil.copy(find_tool("busybox"), root / "bin" / "busybox")
    (root / "bin" / "sh").symlink_to("busybox")
    files = module_files(work, version)
    for file in files:
        shutil.copy(file, root / "modules" / file.name)
    (root / "modules" / "order").write_text("".join(file.name + "\n" for file in files), encoding="utf-8")
    names = "".join(f"{path.relative_to(root)}\n" for path in sorted(root.rglob("*")))
    archive = subprocess.run(["cpio", "-o", "-H", "newc", "--quiet"], cwd=root, input=names.encode(), capture_output=True, check=True).stdout
    with gzip.open(target, "wb", compresslevel=1) as file:
        file.write(archive)


def prepare_kernel(target):
    with tempfile.TemporaryDirectory(prefix="panvo_kernel_", dir=target.parent) as name:
        work = pathlib.Path(name)
        package = kernel_package()
        print(f"virtual_machine: downloading {package} (only once)", file=sys.stderr)
        output_of(["apt-get", "-qq", "download", package], cwd=work, timeout=DOWNLOAD_S)
        archive = next(work.glob("*.deb"))
        with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", str(archive)], stdout=subprocess.PIPE) as unpacker:
            output_of(["tar", "-x", "-C", str(work), "--wildcards", *WANTED], stdin=unpacker.stdout, timeout=UNPACK_S)
        version = next((work / "lib" / "modules").iterdir()).name
        output_of(["depmod", "-b", str(work), version], timeout=UNPACK_S)
        made = work / "made"
        made.mkdir()
        (made / "vmlinux").write_bytes(unpacked_kernel((work / "boot" / f"vmlinuz-{version}").read_bytes()))
        write_first_files(work, version, made / "modules.gz")
        made.rename(target)


def kernel_folder():
    """The folder with vmlinux and modules.gz; created if missing."""
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "panvo" / "virtual_machine"
    cache.mkdir(parents=True, exist_ok=True)
    target = cache / ("kernel_" + "_".join(MODULES))  # a different module list needs a different folder
    with open(cache / "lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not target.is_dir():
            prepare_kernel(target)
    return target


def accelerator():
    """KVM on physical machines only, because nested KVM may fail to start a stock kernel; otherwise emulation."""
    is_real = any(pathlib.Path("/sys/module", module).is_dir() for module in ("kvm_intel", "kvm_amd"))
    return ["-accel", "kvm", "-cpu", "host"] if is_real and os.access("/dev/kvm", os.W_OK) else ["-accel", "tcg,thread=multi", "-cpu", "Nehalem"]


def initrd_with_init(kernel, folder):
    """Initrd of two concatenated archives, as the kernel allows: the modules, and the init of this folder."""
    init = pathlib.Path(__file__).with_name("init")
    root = folder / "first"
    root.mkdir()
    shutil.copy(init, root / "init")
    (root / "init").chmod(0o755)
    archive = subprocess.run(["cpio", "-o", "-H", "newc", "--quiet"], cwd=root, input=b"init\n", capture_output=True, check=True).stdout
    whole = folder / "initrd.gz"
    whole.write_bytes((kernel / "modules.gz").read_bytes() + gzip.compress(archive, 1))
    return whole


def run(arguments):
    kernel = kernel_folder()
    exchange = pathlib.Path(arguments.exchange).resolve()
    (exchange / "command").write_text(f"cd {shlex.quote(os.getcwd())}\nexec {shlex.join(arguments.words)}\n", encoding="utf-8")
    begun, output, status = (exchange / name for name in ("begun", "output", "status"))  # written by init
    for file in (begun, output, status):
        file.unlink(missing_ok=True)
    modules = " ".join(["module." + module for module in arguments.module] + ALWAYS)
    with tempfile.TemporaryDirectory(prefix="panvo_machine_") as name:
        initrd, console = initrd_with_init(kernel, pathlib.Path(name)), pathlib.Path(name) / "console"
        machine = ["qemu-system-x86_64", *accelerator(), "-machine", "q35", "-nodefaults", "-no-user-config", "-no-reboot", "-display", "none",
                   "-m", "1024", "-smp", "2", "-kernel", str(kernel / "vmlinux"), "-initrd", str(initrd),
                   "-append", f"console=ttyS0 ignore_loglevel no_timer_check panic=-1 mitigations=off {modules}", "-serial", "stdio",
                   "-monitor", "none", "-device", "virtio-rng-pci",
                   "-virtfs", "local,path=/,mount_tag=host,security_model=none,readonly=on,multidevs=remap",
                   "-virtfs", f"local,path={exchange},mount_tag=exchange,security_model=none"]
        # A start takes 8 s on an idle machine, over a minute on a heavily loaded one.
        with open(console, "wb") as file, contextlib.suppress(subprocess.TimeoutExpired):
            subprocess.run(machine, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT, timeout=arguments.limit, check=False)
        said = console.read_text(encoding="utf-8", errors="replace")
    result = int(status.read_text(encoding="utf-8")) if status.is_file() else TOO_LONG
    sys.stdout.write(output.read_text(encoding="utf-8", errors="replace") if output.is_file() else "")
    if not status.is_file():
        print(f"virtual_machine: not finished within {arguments.limit} s; its command {'had' if begun.exists() else 'had not'} started")
    if result != 0:
        print(f"virtual_machine: kernel log\n{said}")
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    verbs.add_parser("check")
    runner = verbs.add_parser("run")
    runner.add_argument("--limit", type=float, default=90.0, metavar="S", help="time limit in seconds; then the machine is stopped")
    runner.add_argument("--module", action="append", default=[], metavar="NAME=ARGUMENTS", help="arguments of a kernel module, separated by ;")
    runner.add_argument("exchange")
    runner.add_argument("words", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    try:
        require_tools()
        if arguments.verb == "check":
            kernel_folder()
            return 0
        return run(arguments)
    except CannotBe as reason:
        print(reason, file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
