# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: install missing Debian packages

source "$PANVO_SCRIPTS/lib/packages.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo setup [--check | --list] [GROUP... | --all]

Installs missing Debian packages, with sudo unless run as root. Groups: build (default), python, page (of 'panvo view'), colcon, witness (of the
tests), lint, clang, package, arm64, docs; --all: every group. Other commands, such as demo and test, install the packages that they need.

  --check   install nothing; list the missing packages and fail if there are any
  --list    only print the package names

The packages and their purposes are listed in launch_scripts/packages.txt.
EOT
}

verb_main() {
  local action=install group
  local -a groups=()
  while (($#)); do
    case $1 in
      --check) action=check ;;
      --list) action=list ;;
      --all) mapfile -t groups < <(package_groups) ;;
      -*) unknown_option "$1" ;;
      *) groups+=("$1") ;;
    esac
    shift
  done
  ((${#groups[@]})) || groups=(build)
  for group in "${groups[@]}"; do
    package_groups | grep -qxF -- "$group" || fail "unknown group '$group'; available: $(package_groups | xargs)" 2
  done

  case $action in
    list)
      local -a entries
      mapfile -t entries < <(packages_of "${groups[@]}")
      chosen_packages "${entries[@]}"
      ;;
    check)
      local missing
      missing=$(missing_packages "${groups[@]}")
      if [[ -n $missing ]]; then
        printf '%s\n' "$missing"
        fail "missing packages, listed above; 'panvo setup ${groups[*]}' installs them"
      fi
      ;;
    install)
      ensure_packages "${groups[@]}"
      note "all packages of ${groups[*]} are installed"
      ;;
  esac
}
