# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: record topics into a bag

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo record --out DIR [--set recorder.parameter=value ...]

Records what is on the network into a rosbag2 folder below DIR until Ctrl-C: `panvo run record`. `panvo component show panvo_recorder`
names the recorder's parameters, `panvo bag info` looks into the result.
EOT
}

verb_main() { start_program panvo_run "$(system_file record)" "$@"; }
