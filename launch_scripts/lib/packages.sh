# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Finds and installs missing Debian packages of packages.txt.

# packages_of GROUP...: entries under [GROUP] in packages.txt: a package, or alternatives "a|b".
packages_of() {
  local group
  for group in "$@"; do
    awk -v group="[$group]" '
      /^\[/ { wanted = ($1 == group); known = known || wanted; next }
      { sub(/#.*/, "") }
      wanted && NF { print $1 }
      END { exit !known }' "$PANVO_SCRIPTS/packages.txt" || fail "packages.txt has no group [$group]"
  done
}

package_groups() { sed -n 's/^\[\(.*\)\].*/\1/p' "$PANVO_SCRIPTS/packages.txt"; }

# chosen_packages A|B...: package names; of alternatives the first that this distribution has.
chosen_packages() {
  local entry name
  for entry in "$@"; do
    for name in ${entry//|/ } "${entry%%|*}"; do
      [[ $entry != *'|'* ]] || package_lists_know "$name" || continue
      break
    done
    printf '%s\n' "$name"
  done
}

# missing_packages GROUP...: entries without a package that is installed or provided by an installed one.
missing_packages() {
  local entry name present
  local -a wanted
  mapfile -t wanted < <(packages_of "$@")
  ((${#wanted[@]})) || fail "packages.txt lists nothing for: $*"
  present=" $(present_packages | tr '\n' ' ')"
  for entry in "${wanted[@]}"; do
    for name in ${entry//|/ }; do
      [[ $present != *" $name "* ]] || continue 2
    done
    printf '%s\n' "$entry"
  done | sort -u
}

# Sorted names of installed packages and of what they provide: a nodejs from elsewhere than Debian provides npm and excludes Debian's.
# One dpkg-query for all, because this runs before every command that builds.
present_packages() {
  dpkg-query -W -f '${db:Status-Status} ${Package}, ${Provides}\n' |
    sed -n 's/^installed //p' | tr ',' '\n' | awk 'NF { print $1 }' | sort -u
}

# ensure_packages GROUP...: installs missing packages; silent if there are none.
ensure_packages() {
  if ! command -v dpkg-query >/dev/null; then
    is_warned_of_packages=${is_warned_of_packages:-}
    [[ -n $is_warned_of_packages ]] || note "no dpkg found: install the packages listed in $PANVO_SCRIPTS/packages.txt yourself"
    is_warned_of_packages=yes
    return
  fi
  local -a missing
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]} == 0)) || install_packages "${missing[@]}"
}

# install_if_possible GROUP...: like ensure_packages, but only reports missing packages if they cannot be installed without a password.
install_if_possible() {
  local -a missing
  command -v dpkg-query >/dev/null || return 0
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  if may_install; then
    install_packages "${missing[@]}"
  else
    note "not installed: ${missing[*]}. What needs them is left out; 'panvo setup $*' installs them"
  fi
}

may_install() { ((EUID == 0)) || { command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; }; }

install_packages() {
  local -a as_root=()
  if ((EUID != 0)); then
    if may_install; then
      as_root=(sudo)
    else
      fail "packages are missing, and installing them needs root. Run as root:
  apt-get install --no-install-recommends $(chosen_packages "$@" | tr '\n' ' ')"
    fi
  fi
  local log
  log=$(mktemp "${TMPDIR:-/tmp}/panvo-setup.XXXXXX.log")
  note "installing $# missing packages and their dependencies (log: $log)"
  if ! package_lists_know "$@"; then
    note "reading package lists"
    "${as_root[@]}" apt-get update -q >>"$log" 2>&1 || note "apt-get update failed; continuing with the present package lists"
  fi
  local -a chosen
  mapfile -t chosen < <(chosen_packages "$@")
  if ! apt_install "${chosen[@]}" && ! { refresh_after_failure && apt_install "${chosen[@]}"; }; then
    tail -n 20 "$log" >&2
    fail "installing packages failed; full log: $log. To install by hand: apt-get install --no-install-recommends ${chosen[*]}"
  fi
  note "packages installed"
}

# apt_install and refresh_after_failure use the caller's as_root and log. Automatic upgrades hold apt's lock for minutes on a machine that just started.
apt_install() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends \
    -o DPkg::Lock::Timeout=600 -o Dpkg::Use-Pty=0 -o Dpkg::Options::=--force-confold "$@" </dev/null 2>&1 | tee -a "$log" | show_apt_progress
}

# Old package lists name files that the mirror no longer has.
refresh_after_failure() {
  note "refreshing the package lists and trying again"
  "${as_root[@]}" apt-get update -q >>"$log" 2>&1
}

# package_lists_know A|B...: whether apt knows one of each alternatives.
package_lists_know() {
  local entry name
  for entry in "$@"; do
    for name in ${entry//|/ }; do
      ! apt-cache show --no-all-versions "$name" >/dev/null 2>&1 || continue 2
    done
    return 1
  done
}

# Shows apt's progress: one updated line on a terminal, else a line per 20 %.
show_apt_progress() {
  local line total=1 unpacked=0 set_up=0
  local -A seen=()
  # Not awk: mawk, Debian's default, waits for a full block of input before it reads the first line.
  while IFS= read -r line; do
    case $line in
      'Need to get '*) show_step "downloading ${line#Need to get }" ;;
      *' newly installed,'*) [[ $line =~ ([0-9]+)' newly installed' ]] && total=${BASH_REMATCH[1]} ;;
      *'Could not get lock'*)
        [[ -n ${seen[lock]:-} ]] || show_step "waiting for ${line##*held by }"
        seen[lock]=yes
        ;;
      'Get:'*) ! is_terminal || show_step "downloading: ${line#* }" ;;
      'Unpacking '*) unpacked=$((unpacked + 1)) && show_count unpacked "$unpacked" ;;
      'Setting up '*) set_up=$((set_up + 1)) && show_count 'set up' "$set_up" ;;
    esac
  done
  ! is_terminal || printf '\r\033[K' >&2
}

show_step() {
  if is_terminal; then printf '\r\033[K  %s' "${1:0:100}" >&2; else printf '  %s\n' "$1" >&2; fi
}

# show_count WHAT N: N of the caller's total; not on a terminal, only every 20 % of each WHAT, remembered in the caller's seen.
show_count() {
  local fifth=$((5 * $2 / (total > 0 ? total : 1)))
  if is_terminal || [[ $fifth != "${seen[$1]:-0}" ]]; then show_step "$1 $2 of $total"; fi
  seen[$1]=$fifth
}
