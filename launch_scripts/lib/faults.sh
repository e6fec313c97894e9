# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# panvo bench faults: recordings with faults through the whole system, and how far its poses were to be trusted.

source "$PANVO_SCRIPTS/lib/simulated.sh"

faults_usage() {
  cat <<'EOT'
usage: panvo bench faults [--quick] [--only KIND,...] [--inputs DIR,...] [--seeds N] [--out DIR] [--jobs N]
       panvo bench faults --list

Plays recordings with truth through the whole system in one process, each time with another fault between the recording and the system or between
two of its components, and prints a table, a line for each kind of fault: the largest error over sigma, how often the error was outside what
95 % and 99.9 % of all should be within, for how long the state was tracking while the error was over 3 sigma, how soon an alarm came and the system
recovered, and what the protection level was worth. The last lines say which of the goals hold.

  --quick        one seed, and only the cheapest recording: campus_clip of $PANVO_DATA
  --only KINDS   these kinds of fault (--list names them)
  --inputs DIRS  recordings of your own: EuRoC/ASL with stereo pairs, panoramas and truth (default: campus_clip where there is one, and two
                 simulated drives of the route 'short', rendered once, some minutes each, and kept)
  --seeds N      how often each fault is played on each recording, drawn anew (default: 5)
  --out DIR      folder of the results (default: runs/faults); what was played there with the same programs is not played again
  --jobs N       runs at once (default: 1)
  --list         list the kinds of fault

In the folder: faults.txt, faults.csv, faults.json, faults.png, and in runs/ what each run left. Exit status 0: all ran, whatever came out;
1: some failed; 2: wrong usage.
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
      *) fail "'$1' is no option of panvo bench faults; kinds of fault go after --only" 2 ;;
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
    [[ -n $found ]] || fail "there is no campus_clip in the folder of recordings (PANVO_DATA): name a recording with --inputs, or go without --quick"
    readarray -t inputs <<<"$found"
  fi
  for input in "${inputs[@]}"; do options+=(--inputs "$input"); done
  exec "$(program panvo_fault_bench)" "${options[@]}" "${seeds[@]}" --out "${out:-$PANVO_HOME/runs/faults}" --key "$(fault_key)"
}

# fault_inputs QUICK: the recordings that are played when none are named, a line each.
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

# fault_key: of the programs, plugins, libraries and settings that a run depends on.
fault_key() {
  local plugins
  plugins=$(build_folder)/panvo_plugins
  {
    sha256sum "$(program panvo_run)" "$plugins"/*.so
    ldd "$(program panvo_run)" "$plugins"/*.so | sed -n 's/.*libpanvo_[^ ]* => \([^ ]*\).*/\1/p' | sort -u | xargs sha256sum
    sha256sum "$PANVO_HOME/tests/fault_bench/faults.yaml"
  } | sha256sum | cut -c 1-16
}
