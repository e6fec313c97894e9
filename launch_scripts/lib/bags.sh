# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Bags, and the run files derived from them. Needs build.sh and systems.sh.

# is_bag PATH: whether PATH is a rosbag2 folder or one file of a bag.
is_bag() {
  if [[ -d $1 ]]; then
    local name
    for name in metadata.yaml '*.db3' '*.mcap' '*.db3.zstd' '*.mcap.zstd'; do
      ! compgen -G "$1/$name" >/dev/null || return 0
    done
    return 1
  else
    [[ -f $1 && $1 == *.@(db3|mcap)?(.zstd) ]]
  fi
}

# results_of_bag BAG: derives the files of a run from the messages of BAG and prints their folder: BAG.results, or a new temporary folder if that
# cannot be written.
results_of_bag() {
  local bag out status=0
  bag=$(readlink -f -- "$1")
  out=$bag.results
  if ! { mkdir -p -- "$out" && [[ -w $out ]]; } 2>/dev/null; then
    out=$(mktemp -d "${TMPDIR:-/tmp}/panvo-results.XXXXXX") || fail "cannot create a folder for the results of '$1' (see above); free space there, or set TMPDIR"
  elif [[ ! -e $out/.panvo_run && -n $(ls -A -- "$out") ]]; then
    fail "'$out' is not from panvo, and the results of the bag belong there; move it away"
  fi
  note "deriving the results of $1 into $out"
  # Results need no images, the largest part of most bags.
  "$(program panvo_run)" "$(system_file play)" "bag:=$bag" 'exclude:=.*/image.*' --replay --local --out "$out" >&2 || status=$?
  case $status in
    0) printf '%s' "$out" ;;
    130 | 143) fail "interrupted" "$status" ;;
    *)
      has_space "$out" || fail "the disk is full: free space for the results of '$1' in $out"
      fail "'$1' is not a readable bag, or has no odometry of panvo (see above). $(run_first "$1")"
      ;;
  esac
}

# has_space FOLDER: whether a megabyte can be written there, as much as the results of a short bag.
has_space() {
  local status=0
  head -c 1000000 /dev/zero 2>/dev/null >"$1/.panvo_space" || status=1
  rm -f -- "$1/.panvo_space"
  return "$status"
}

# run_of_bag BAG: the same for a bag that must hold odometry.
run_of_bag() {
  local out
  out=$(results_of_bag "$1")
  if [[ ! -s $out/odometry_enhanced.tum && ! -s $out/odometry_binocular.tum ]]; then
    fail "'$1' holds no odometry of panvo (odometry/binocular, odometry/enhanced). $(run_first "$1")"
  fi
  printf '%s' "$out"
}

run_first() { printf 'If it holds images, run a system on it first:\n  panvo run enhanced_vo --bag %q --out DIR' "$1"; }
