# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Functions shared by all commands: paths, messages, errors.

PANVO_HOME=$(dirname "$PANVO_SCRIPTS")  # the checkout, or <prefix>/share/panvo once installed
PANVO_BUILD=${PANVO_BUILD:-release}     # one folder under build/ per build type

note() { printf 'panvo: %s\n' "$*" >&2; }

# fail MESSAGE [STATUS]: prints the error with its remedy and exits.
fail() {
  printf 'panvo %s: %s\n' "${verb:-}" "$1" >&2
  exit "${2:-1}"
}

in_checkout() { [[ -f $PANVO_HOME/CMakeLists.txt ]]; }

# For commands that compile or install and so need the sources.
require_checkout() {
  in_checkout || fail "'panvo $verb' works only in a source checkout, and this is an installed panvo ($PANVO_HOME)"
}

panvo_version() {
  sed -n 's|.*<version>\(.*\)</version>.*|\1|p' "$PANVO_SCRIPTS/package.xml" 2>/dev/null || true
}

is_terminal() { [[ -t 2 ]]; }

# require_value "$@": fails if the option in $1 has no value after it.
require_value() {
  (($# >= 2)) || fail "$1 needs a value (panvo $verb --help)" 2
}

unknown_option() {
  fail "unknown option '$1' (panvo $verb --help lists the options)" 2
}

# edit_distance A B: Levenshtein distance, row by row.
edit_distance() {
  local a=$1 b=$2 i j cost best
  local -a row=() next=()
  for ((j = 0; j <= ${#b}; ++j)); do row[j]=$j; done
  for ((i = 1; i <= ${#a}; ++i)); do
    next=("$i")
    for ((j = 1; j <= ${#b}; ++j)); do
      cost=1
      [[ ${a:i-1:1} != "${b:j-1:1}" ]] || cost=0
      best=$((row[j - 1] + cost))
      ((row[j] + 1 >= best)) || best=$((row[j] + 1))
      ((next[j - 1] + 1 >= best)) || best=$((next[j - 1] + 1))
      next[j]=$best
    done
    row=("${next[@]}")
  done
  printf '%s' "${row[${#b}]}"
}

# nearest_word WORD CANDIDATE...: the first candidate that begins with WORD, else the first with the smallest edit distance.
nearest_word() {
  local word=$1 candidate distance nearest='' fewest=1000
  shift
  for candidate in "$@"; do
    if [[ $candidate == "$word"* ]]; then
      printf '%s' "$candidate"
      return
    fi
  done
  for candidate in "$@"; do
    distance=$(edit_distance "$word" "$candidate")
    if ((distance < fewest)); then
      fewest=$distance
      nearest=$candidate
    fi
  done
  printf '%s' "$nearest"
}

# runs_folder: default parent folder of results.
runs_folder() {
  local folder=$PWD
  if in_checkout && [[ -w $PANVO_HOME ]]; then folder=$PANVO_HOME; fi
  printf '%s/runs' "$folder"
}

# data_folder: the folder with recordings for test and bench; prints nothing if there is none.
data_folder() {
  if [[ -n ${PANVO_DATA:-} ]]; then
    [[ -d $PANVO_DATA ]] || fail "PANVO_DATA is '$PANVO_DATA', which is not a folder; correct or unset it"
    printf '%s' "$PANVO_DATA"
  elif [[ -d $PANVO_HOME/../shared/data ]]; then
    readlink -f -- "$PANVO_HOME/../shared/data"
  fi
}
