# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Debian packages: which of packages.txt are missing, and how to get them.

# packages_of GROUP...: the package names under [GROUP] in packages.txt.
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

# missing_packages GROUP...: those not installed. One dpkg-query for all of them: this runs before every command.
missing_packages() {
  local -a wanted
  mapfile -t wanted < <(packages_of "$@")
  ((${#wanted[@]})) || fail "packages.txt lists nothing for: $*"
  comm -23 <(printf '%s\n' "${wanted[@]}" | sort -u) \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null | sed -n 's/^installed //p' | sort -u)
}

# ensure_packages GROUP...: installs what is missing; says so only when something is.
ensure_packages() {
  if ! command -v dpkg-query >/dev/null; then
    is_warned_of_packages=${is_warned_of_packages:-}
    [[ -n $is_warned_of_packages ]] || note "no dpkg here: install what $PANVO_SCRIPTS/packages.txt lists by your own means"
    is_warned_of_packages=yes
    return
  fi
  local -a missing
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]} == 0)) || install_packages "${missing[@]}"
}

install_packages() {
  local -a as_root=()
  if ((EUID != 0)); then
    if command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
      as_root=(sudo)
    else
      fail "these packages are missing, and only root may install them. Run:
  apt-get install --no-install-recommends $*"
    fi
  fi
  local log
  log=$(mktemp "${TMPDIR:-/tmp}/panvo-setup.XXXXXX.log")
  note "installing $# missing packages and what they need (log: $log)"
  if ! package_lists_know "$@"; then
    note "reading package lists"
    "${as_root[@]}" apt-get update -q >>"$log" 2>&1 || note "apt-get update had trouble; going on with what there is"
  fi
  if ! apt_install "$@" && ! { refresh_after_failure && apt_install "$@"; }; then
    tail -n 20 "$log" >&2
    fail "installing packages failed; the whole log is $log. By hand: apt-get install --no-install-recommends $*"
  fi
  note "packages installed"
}

# Both use the caller's as_root and log.
apt_install() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends \
    -o Dpkg::Use-Pty=0 -o Dpkg::Options::=--force-confold "$@" </dev/null 2>&1 | tee -a "$log" | show_apt_progress
}

# Lists a week old name package files that the mirror no longer has.
refresh_after_failure() {
  note "refreshing the package lists and trying once more"
  "${as_root[@]}" apt-get update -q >>"$log" 2>&1
}

package_lists_know() {
  local name
  for name in "$@"; do
    apt-cache show --no-all-versions "$name" >/dev/null 2>&1 || return 1
  done
}

# One line that counts up on a terminal, a line for every tenth part elsewhere.
show_apt_progress() {
  local line total=1 unpacked=0 set_up=0 last=''
  # Not awk: Debian's smallest one waits for a whole block of input before it looks at the first line.
  while IFS= read -r line; do
    case $line in
      'Need to get '*) show_step "downloading ${line#Need to get }" ;;
      *' newly installed,'*) [[ $line =~ ([0-9]+)' newly installed' ]] && total=${BASH_REMATCH[1]} ;;
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

# show_count WHAT N: of the caller's total; in a log file only every fifth part.
show_count() {
  local step="$1 $((5 * $2 / (total > 0 ? total : 1)))"
  if is_terminal || [[ $step != "$last" ]]; then show_step "$1 $2 of $total"; fi
  last=$step
}
