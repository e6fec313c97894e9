# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Routes of the simulated campus, given by path or by name in config/routes.

list_routes() {
  local file
  for file in "$PANVO_HOME"/config/routes/*.yaml; do
    [[ -e $file ]] && basename "$file" .yaml
  done | xargs
}

# describe_routes: lists each route with its description.
describe_routes() {
  local file
  for file in "$PANVO_HOME"/config/routes/*.yaml; do
    [[ -e $file ]] && printf '  %-12s %s\n' "$(basename "$file" .yaml)" "$(sed -n 's/^description: *"\{0,1\}\(.*[^"]\)"\{0,1\}$/\1/p' "$file")"
  done
}

# route_file NAME_OR_PATH
route_file() {
  local named=$PANVO_HOME/config/routes/${1%.yaml}.yaml
  local -a known
  if [[ -f $1 ]]; then
    readlink -f -- "$1"
  elif [[ $1 != */* && -f $named ]]; then
    printf '%s' "$named"
  elif [[ $1 == */* || $1 == *.yaml ]]; then
    fail "route file '$1' not found (routes in config/routes: $(list_routes))"
  else
    read -r -a known <<<"$(list_routes)"
    fail "unknown route '$1'; did you mean '$(nearest_word "$1" "${known[@]}")'? (available: ${known[*]}; panvo simulate --help)" 2
  fi
}
