# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# The build type arm64: cross-compiled with config/build/arm64.cmake, run under qemu. Needs packages.sh.

source "$PANVO_SCRIPTS/lib/sysroot.sh"

# arch_build NAME: build type of `--arch NAME`.
arch_build() {
  [[ $1 == @(arm64|aarch64) ]] || fail "unknown architecture '$1'; use arm64 (without --arch, panvo builds for this machine)" 2
  [[ $(uname -m) != aarch64 ]] || fail "this machine is arm64 itself: omit --arch" 2
  echo arm64
}

# prepare_arm64: cross compiler, emulator and libraries.
prepare_arm64() {
  ensure_packages arm64
  ensure_sysroot arm64
}

# with_arm64 COMMAND ARGUMENT...: runs a command of this machine that may start arm64 programs, also through others (scripts, tests). Where the
# kernel was not told to start qemu for them (Debian: qemu-user-binfmt), tells it for this command only, in a user namespace; Linux 6.7 can.
with_arm64() {
  local -a start=()
  export QEMU_LD_PREFIX=$PANVO_HOME/build/sysroot-arm64
  if ! starts_arm64; then
    start=(unshare --user --map-root-user --mount bash "$PANVO_SCRIPTS/lib/binfmt_arm64.sh")
    "${start[@]}" true 2>/dev/null || fail "the kernel does not start arm64 programs, and starting them in a user namespace is not permitted or
needs Linux 6.7. As root:
  apt-get install --no-install-recommends qemu-user-binfmt"
  fi
  "${start[@]}" "$@"
}

# exec_arm64 PROGRAM ARGUMENT...: replaces this shell by an arm64 program.
exec_arm64() {
  with_arm64 "$@"
  exit
}

# starts_arm64: whether the kernel starts arm64 programs. The loader is one that needs no libraries.
starts_arm64() { [[ $(uname -m) == aarch64 ]] || "$QEMU_LD_PREFIX/lib/ld-linux-aarch64.so.1" --version >/dev/null 2>&1; }
