# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: install what is missing on this machine

source "$PANVO_SCRIPTS/lib/packages.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo setup [--check | --list] [GROUP... | --all]

Installs the Debian packages that are missing, with sudo when you are not root. Groups: build (default), colcon, lint;
--all means every group. demo, test and the others call it themselves.

  --check   install nothing; list what is missing and fail when anything is
  --list    print the package names and do nothing

The list is launch_scripts/packages.txt.
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
    package_groups | grep -qxF -- "$group" || fail "there is no group '$group'; there are: $(package_groups | xargs)" 2
  done

  case $action in
    list) packages_of "${groups[@]}" ;;
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
      note "everything for ${groups[*]} is installed"
      ;;
  esac
}
