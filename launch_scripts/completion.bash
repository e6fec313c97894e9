# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Completion of `panvo` in bash. What it offers comes from --help: commands, their subcommands and options, systems and routes.
# Everything else completes to files.

_panvo() {
  local word=${COMP_WORDS[COMP_CWORD]} verb=${COMP_WORDS[1]} panvo=${COMP_WORDS[0]/#\~\//$HOME/} choices=''
  if ((COMP_CWORD == 1)); then
    choices="$("$panvo" --help 2>/dev/null | sed -nE 's/^  ([a-z][a-z-]*)  .*/\1/p') --help --version"
  elif [[ $word == -* ]]; then
    choices=$("$panvo" "$verb" --help 2>/dev/null | grep -oE -e '(^|[^[:alnum:]_-])--[a-z][a-z-]*' | grep -oe '--.*')' --help'
  elif ((COMP_CWORD == 2)); then
    choices=$("$panvo" "$verb" --help 2>/dev/null | _panvo_first_arguments "panvo $verb ")
  fi
  mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
}

# _panvo_first_arguments COMMAND: subcommands, systems and routes in a text of --help.
_panvo_first_arguments() {
  awk -v command="$1" '
    { sub(/^usage:/, "      ") }
    index($0, "       " command) == 1 {
      count = split(substr($0, length(command) + 8), forms, / \| /)
      for (i = 1; i <= count; ++i) {
        split(forms[i], words, " ")
        if (words[1] ~ /^[a-z][a-z-]*$/) print words[1]
      }
    }
    /^ROUTE is/ { lists_routes = 1; next }
    !NF { lists_routes = 0 }
    lists_routes { print $1 }
    sub(/^Systems: /, "")'
}

complete -o bashdefault -o default -F _panvo panvo
