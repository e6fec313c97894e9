# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: list connected cameras with serial numbers, formats and rates

source "$PANVO_SCRIPTS/lib/build.sh"

# Each driver has a program panvo_devices_<name> that lists its cameras; a driver that was not built is left out.
device_listers=(aravis v4l2)

verb_usage() {
  cat <<'EOT'
usage: panvo devices [--json] [--simulated]

Lists the cameras that the drivers find: serial number (for `cameras`, a parameter of the drivers), maker, model and address; pixel formats,
image sizes and frame rates. A camera used by another program is listed as in use.

  --json       JSON output, one list of objects per driver
  --simulated  include the simulated camera of Aravis
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
  [[ $found == yes ]] || note "no camera found. Check cable and power; a GigE camera must be in this host's network (drivers/v4l2_camera/README.md, drivers/aravis_camera/README.md)"
}
