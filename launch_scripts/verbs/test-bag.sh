# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: regression test: replay a recording and compare with stored results

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/bags.sh"
source "$PANVO_SCRIPTS/lib/supervise.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo test-bag BAG --expect RESULTS [--system SYSTEM] [--within-m M --within-deg D] [--set C.P=V ...] [--out DIR]
       panvo test-bag BAG --record RESULTS [--system SYSTEM] [--set C.P=V ...]

Replays BAG (a rosbag2 folder, an .mcap or .db3 file, or a data set) through a system and compares trajectories and events with
those in RESULTS, written earlier by --record or by `panvo run --replay --out RESULTS`.
Exit status 0: equal; 1: different; 2: nothing to compare.

  --system SYSTEM   system file, or the name of one in config/systems (default: enhanced_vo)
  --within-m M      position tolerance, m; without --within-m and --within-deg, results must be bit-identical
  --within-deg D    orientation tolerance, degrees; give both if BAG or RESULTS comes from another machine
  --set C.P=V       set parameter P of component C
  --out DIR         keep the results of this run in DIR (default: a temporary folder, which is kept if the run fails)

EOT
}

verb_main() {
  local bag='' expected='' recorded='' system=enhanced_vo out=''
  local -a settings=() tolerances=()
  while (($#)); do
    case $1 in
      --expect | --record | --system | --out | --set | --within-m | --within-deg)
        require_value "$@"
        case $1 in
          --expect) expected=$2 ;;
          --record) recorded=$2 ;;
          --system) system=$2 ;;
          --out) out=$2 ;;
          --set) settings+=(--set "$2") ;;
          *) tolerances+=("$1" "$2") ;;
        esac
        shift
        ;;
      -*) fail "unknown option '$1' (panvo test-bag --help)" 2 ;;
      *)
        [[ -z $bag ]] || fail "only one recording is allowed: '$bag' or '$1'?" 2
        bag=$1
        ;;
    esac
    shift
  done
  [[ -n $bag ]] || fail "name a recording (panvo test-bag --help)" 2
  [[ -e $bag ]] || fail "recording '$bag' not found" 2
  [[ -n $expected || -n $recorded ]] || fail "name the results to compare with: --expect RESULTS; --record RESULTS creates them" 2
  [[ -z $expected || -z $recorded ]] || fail "--expect and --record cannot be combined" 2
  [[ -z $expected || -d $expected ]] || fail "no results in '$expected'; --record $expected creates them" 2
  system=$(system_file "$system")
  supervise replay_and_compare
}

replay_and_compare() {
  local is_temporary=no
  use_built panvo_run panvo_compare_runs
  use_plugins
  if [[ -n $recorded ]]; then
    out=$recorded
  elif [[ -z $out ]]; then
    out=$(mktemp -d "${TMPDIR:-/tmp}/panvo-test-bag.XXXXXX")
    is_temporary=yes
  fi
  local kind=--bag status=0
  [[ ! -d $bag ]] || is_bag "$bag" || kind=--dataset
  note "replaying $bag through $(basename "$system" .yaml)"
  run_to_its_end "$out" "$system" "$kind" "$bag" --replay "${settings[@]}" >&2
  if [[ -n $recorded ]]; then
    note "results are in $recorded; compare with: panvo test-bag $(printf '%q --expect %q --system %q' "$bag" "$recorded" "$system")"
    return
  fi
  "$(program panvo_compare_runs)" "$out" "$expected" "${tolerances[@]}" || status=$?
  [[ $is_temporary == no ]] || rm -rf -- "$out"  # that of a failed run holds its log
  return "$status"
}
