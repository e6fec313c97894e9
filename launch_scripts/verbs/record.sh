# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: record topics into a bag

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo record BAG [TOPIC...] [--exclude TOPIC] [--no-images] [--storage NAME] [--overwrite] [option of panvo run ...]

Records topics into the rosbag2 folder BAG until Ctrl-C. TOPIC is a name or a regular expression that must match the whole
name, such as '/stereo/.*'; default: all topics.

  --exclude TOPIC      do not record this topic
  --no-images          do not record sensor_msgs/Image and CompressedImage
  --storage NAME       sqlite3 (.db3 files) or mcap
  --compression NAME   none, lz4 or zstd; lz4 and zstd imply mcap
  --overwrite          replace an existing bag

`panvo bag info BAG` shows the contents, `panvo play BAG` plays them.
EOT
}

verb_main() {
  local bag='' topics='' exclude=''
  local -a rest=()
  while (($#)); do
    case $1 in
      --exclude)
        require_value "$@"
        exclude+="${exclude:+ }$2"
        shift
        ;;
      --storage)
        require_value "$@"
        rest+=("storage:=$2")
        shift
        ;;
      --compression)
        require_value "$@"
        rest+=("compression:=$2")
        [[ $2 == none ]] || rest+=(storage:=mcap)
        shift
        ;;
      --no-images) rest+=(include_images:=false) ;;
      --overwrite) rest+=(overwrite:=true) ;;
      -* | *:=*)
        rest+=("$1")
        if takes_value "$1"; then
          require_value "$@"
          rest+=("$2")
          shift
        fi
        ;;
      *) if [[ -z $bag ]]; then bag=$1; else topics+="${topics:+ }$1"; fi ;;
    esac
    shift
  done
  [[ -n $bag ]] || fail "name a folder for the bag (panvo record --help)" 2
  local system
  system=$(system_file record)
  start_program panvo_run "$system" "output:=$bag" "topics:=$topics" "exclude:=$exclude" "${rest[@]}"
}
