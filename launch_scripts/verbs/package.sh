# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: make Debian packages

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo package [--out DIR]

Compiles for /usr into build/package and makes three Debian packages of this Debian release and architecture: panvo (programs, libraries,
components, system files, service), panvo-simulation (the simulator; `panvo demo` needs it) and libpanvo-dev (to compile components of your own).

  --out DIR   folder for the packages (default: build/package/packages)
EOT
}

verb_main() {
  require_checkout
  PANVO_BUILD=package
  local out
  out=$(build_folder)/packages
  while (($#)); do
    case $1 in
      --out)
        require_value "$@"
        out=$(readlink -m -- "$2")
        shift
        ;;
      *) unknown_option "$1" ;;
    esac
    shift
  done
  ensure_packages package page
  ensure_built all
  (umask 022 && cd "$(build_folder)" && cpack -G DEB -B "$out" >package.log 2>&1) ||
    fail "making the packages failed; full log: $(build_folder)/package.log"
  rm -rf -- "$out/_CPack_Packages"
  printf '%s\n' "$out"/*.deb
}
