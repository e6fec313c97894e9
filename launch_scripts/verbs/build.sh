# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: compile everything incrementally

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo build [--debug | --sanitize KIND | --arch ARCH] [--colcon [argument...]] [TARGET...]

Compiles into build/release, or into the folder of another build type:

  --debug           unoptimised, into build/debug
  --sanitize KIND   address, undefined or thread, into build/asan, build/ubsan or build/tsan
  --arch ARCH       arm64: cross-compile for 64-bit ARM (Raspberry Pi, Jetson), into build/arm64. The arm64 libraries are unpacked into
                    build/sysroot-arm64 (300 MB to download once); that needs no root
  --colcon          build package by package with colcon, into build/, install/ and log/ (with --sanitize KIND:
                    install/asan, ...); all arguments after --colcon are passed to `colcon build`
  TARGET...         build only these ninja targets, for example panvo_run (default: all)

All other commands use build/release unless PANVO_BUILD is set (debug, asan, ubsan, tsan, clang, fuzz, arm64).
EOT
}

verb_main() {
  require_checkout
  local -a targets=()
  while (($#)); do
    case $1 in
      --debug) PANVO_BUILD=debug ;;
      --sanitize)
        require_value "$@"
        PANVO_BUILD=$(sanitizer_build "$2")
        shift
        ;;
      --arch)
        require_value "$@"
        PANVO_BUILD=$(arch_build "$2")
        shift
        ;;
      --colcon)
        shift
        source "$PANVO_SCRIPTS/lib/colcon.sh"
        colcon_build "$@"
        return
        ;;
      -*) unknown_option "$1" ;;
      *) targets+=("$1") ;;
    esac
    shift
  done
  ((${#targets[@]})) || targets=(all)
  ensure_built "${targets[@]}"
  note "build/$PANVO_BUILD is up to date"
}
