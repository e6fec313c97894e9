# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# What every verb needs: where things are, how to speak, how to fail.

PANVO_HOME=$(dirname "$PANVO_SCRIPTS")  # the checkout, or <prefix>/share/panvo once installed
PANVO_BUILD=${PANVO_BUILD:-release}     # one folder under build/ for each kind of build

note() { printf 'panvo: %s\n' "$*" >&2; }

# fail MESSAGE [STATUS]: what is wrong and what to do about it.
fail() {
  printf 'panvo %s: %s\n' "${verb:-}" "$1" >&2
  exit "${2:-1}"
}

in_checkout() { [[ -f $PANVO_HOME/CMakeLists.txt ]]; }

# A verb that compiles or installs makes no sense in an installed panvo.
require_checkout() {
  in_checkout || fail "this panvo is installed ($PANVO_HOME); 'panvo $verb' works in a source checkout only"
}

panvo_version() {
  sed -n 's|.*<version>\(.*\)</version>.*|\1|p' "$PANVO_SCRIPTS/package.xml" 2>/dev/null || true
}

is_terminal() { [[ -t 2 ]]; }

# require_value "$@": the option in $1 has a value after it, or it is said.
require_value() {
  (($# >= 2)) || fail "$1 needs a value (panvo $verb --help)" 2
}

unknown_option() {
  fail "unknown option '$1' (panvo $verb --help lists the options)" 2
}

# edit_distance A B: Levenshtein, by rows.
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

# nearest_word WORD CANDIDATE...: the candidate that begins with the word, else the one with the fewest edits; the first of several.
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

# runs_folder: where results go that nobody named a folder for.
runs_folder() {
  local folder=$PWD
  if in_checkout && [[ -w $PANVO_HOME ]]; then folder=$PANVO_HOME; fi
  printf '%s/runs' "$folder"
}

# data_folder: the recordings for demo and test, or nothing.
data_folder() {
  if [[ -n ${PANVO_DATA:-} ]]; then
    [[ -d $PANVO_DATA ]] || fail "PANVO_DATA names '$PANVO_DATA', which is no folder; correct it or unset it"
    printf '%s' "$PANVO_DATA"
  elif [[ -d $PANVO_HOME/../shared/data ]]; then
    readlink -f -- "$PANVO_HOME/../shared/data"
  fi
}
