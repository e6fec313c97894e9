# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: list the cameras that are connected, with serial numbers, formats and rates

source "$PANVO_SCRIPTS/lib/build.sh"

# Each driver has a program panvo_devices_<name> that lists what it can drive; one that was not built is left out.
device_listers=(aravis v4l2)

verb_usage() {
  cat <<'EOT'
usage: panvo devices [--json] [--simulated]

Cameras that the drivers find, a few lines each: the serial number (which goes into a rig's file as one of `cameras`), maker, model and
address; pixel formats, sizes and frame rates. A camera that another program uses is listed, and said to be in use.

  --json       a list of objects for each driver, for scripts
  --simulated  Aravis's own simulated camera, too
EOT
}

verb_main() {
  local name path output found=no arguments=()
  while (($#)); do
    case $1 in
      --json | --simulated) arguments+=("$1") ;;
      *) unknown_option "$1" ;;
    esac
    shift
  done
  if in_checkout && ! compgen -G "$(build_folder)/panvo_bin/panvo_devices_*" >/dev/null; then use_built panvo_devices_v4l2; fi
  for name in "${device_listers[@]}"; do
    path=$(program "panvo_devices_$name" 2>/dev/null) || continue
    output=$("$path" "${arguments[@]}") || fail "panvo_devices_$name failed; the messages above say why"
    [[ -z $output ]] || { printf '%s\n' "$output"; found=yes; }
  done
  [[ $found == yes ]] || note "no camera answers. Is it connected, powered, and for GigE in this network? (drivers/v4l2_camera/README.md, drivers/aravis_camera/README.md)"
}
