# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# What the benchmarks over simulated drives have in common: seeds, and a page of results.

# split_seeds LIST: sets `seeds` to the numbers of a list like 301,302.
split_seeds() {
  [[ $1 =~ ^[0-9]+(,[0-9]+)*$ ]] || fail "--seeds '$1': give numbers, separated by commas" 2
  # shellcheck disable=SC2034  # the caller's
  IFS=, read -r -a seeds <<<"$1"
}

# prepare_page FILE: builds the programs, and creates the folder of the page.
prepare_page() {
  ensure_built panvo_programs
  use_plugins
  mkdir -p -- "$(dirname -- "$1")" || fail "cannot create the folder of '$1'; name another file with --out"
}
