# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: list components and what parameters they take

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo component list | panvo component show PACKAGE

The components that are found; the parameters of a package, with units, defaults and ranges.
EOT
  show_program_help panvo_component
}

verb_main() { start_program panvo_component "$@"; }
