# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: compile everything, incrementally

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo build [--debug | --sanitize KIND] [--colcon [argument...]] [TARGET...]

Compiles into build/<kind>: build/release, or another kind:

  --debug           build/debug, not optimised
  --sanitize KIND   address, undefined or thread: build/asan, build/ubsan, build/tsan
  --colcon          one package after another with colcon instead, into build/, install/ and log/ (with --sanitize KIND:
                    install/asan, ...); everything after --colcon goes to `colcon build`
  TARGET...         only these ninja targets, for example panvo_run (default: all)

The other verbs use build/release; PANVO_BUILD=debug (asan, ubsan, tsan) makes them use another.
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
