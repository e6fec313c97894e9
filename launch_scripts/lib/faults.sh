# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# panvo bench faults: plays recordings with injected faults through the whole system and evaluates errors and integrity.

source "$PANVO_SCRIPTS/lib/simulated.sh"

faults_usage() {
  cat <<'EOT'
usage: panvo bench faults [--quick] [--only KIND,...] [--inputs DIR,...] [--seeds N] [--out DIR] [--jobs N]
       panvo bench faults --list

Plays recordings with ground truth through the whole system in one process. Each run has one fault, injected between the recording and the system
or between two components. Prints a table with one line per kind of fault: largest error in sigma, fraction of errors outside the 95 % and 99.9 %
bounds, time in state tracking with an error over 3 sigma, delay of the alarm, recovery time, and quality of the protection level. The last lines
list the goals and whether they are met.

  --quick        one seed, and only the smallest recording: campus_clip in $PANVO_DATA
  --only KINDS   only these kinds of fault (see --list)
  --inputs DIRS  use these recordings: EuRoC/ASL with stereo pairs, panoramas and ground truth (default: campus_clip if present, and two
                 simulated drives along the route 'short', rendered once, several minutes each, and cached)
  --seeds N      number of random variants of each fault per recording (default: 5)
  --out DIR      folder for the results (default: runs/faults); runs already there are reused if the programs are unchanged
  --jobs N       number of parallel runs (default: 1)
  --list         list the kinds of fault

Files in the folder: faults.txt, faults.csv, faults.json, faults.png; runs/ holds the results of each run. Exit status 0: all runs completed, whatever
the errors; 1: some runs failed; 2: wrong usage.
EOT
}

bench_faults() {
  local quick='' out='' given_inputs='' found input
  local -a options=() inputs=() seeds=()
  while (($#)); do
    case $1 in
      -h | --help)
        faults_usage
        return
        ;;
      --quick) quick=yes ;;
      --list) options+=(--list) ;;
      --only | --jobs)
        require_value "$@"
        options+=("$1" "$2")
        shift
        ;;
      --seeds)
        require_value "$@"
        seeds=(--seeds "$2")
        shift
        ;;
      --inputs)
        require_value "$@"
        given_inputs=$2
        shift
        ;;
      --out)
        require_value "$@"
        out=$2
        shift
        ;;
      -*) unknown_option "$1" ;;
      *) fail "unexpected argument '$1'; kinds of fault are given with --only (panvo bench faults --help)" 2 ;;
    esac
    shift
  done
  ensure_built panvo_fault_bench
  use_plugins
  if [[ " ${options[*]} " == *' --list '* ]]; then exec "$(program panvo_fault_bench)" --list; fi
  [[ -n ${seeds[*]} ]] || seeds=(--seeds "$([[ -n $quick ]] && echo 1 || echo 5)")
  if [[ -n $given_inputs ]]; then
    IFS=, read -r -a inputs <<<"$given_inputs"
  else
    found=$(fault_inputs "$quick")
    [[ -n $found ]] || fail "no campus_clip in the folder of recordings (PANVO_DATA): name a recording with --inputs, or omit --quick"
    readarray -t inputs <<<"$found"
  fi
  for input in "${inputs[@]}"; do options+=(--inputs "$input"); done
  exec "$(program panvo_fault_bench)" "${options[@]}" "${seeds[@]}" --out "${out:-$PANVO_HOME/runs/faults}" --key "$(fault_key)"
}

# fault_inputs QUICK: default recordings, one per line.
fault_inputs() {
  local data
  data=$(data_folder)
  if [[ -n $data && -d $data/campus_clip ]]; then printf '%s\n' "$data/campus_clip"; fi
  [[ -z $1 ]] || return 0
  ensure_built panvo_simulate
  simulated_dataset short 4 all
  printf '\n'
  simulated_dataset short 9 none
  printf '\n'
}

# fault_key: hash of the programs, plugins, libraries and settings that a run depends on.
fault_key() {
  local plugins
  plugins=$(build_folder)/panvo_plugins
  {
    sha256sum "$(program panvo_run)" "$plugins"/*.so
    ldd "$(program panvo_run)" "$plugins"/*.so | sed -nE 's/.*libpanvo_[^ ]* => (.*) \(0x[0-9a-f]+\)$/\1/p' | sort -u | xargs -d '\n' sha256sum
    sha256sum "$PANVO_HOME/tests/fault_bench/faults.yaml"
  } | sha256sum | cut -c 1-16
}
