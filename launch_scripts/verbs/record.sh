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
  local handed
  local -a handed_on=()
  while (($#)); do
    case $1 in
      --exclude)
        require_value "$@"
        exclude+="${exclude:+ }$2"
        shift
        ;;
      --storage)
        require_value "$@"
        handed_on+=("storage:=$2")
        shift
        ;;
      --compression)
        require_value "$@"
        handed_on+=("compression:=$2")
        [[ $2 == none ]] || handed_on+=(storage:=mcap)
        shift
        ;;
      --no-images) handed_on+=(include_images:=false) ;;
      --overwrite) handed_on+=(overwrite:=true) ;;
      -* | *:=*)
        hand_on "$@"
        shift $((handed - 1))
        ;;
      *) if [[ -z $bag ]]; then bag=$1; else topics+="${topics:+ }$1"; fi ;;
    esac
    shift
  done
  [[ -n $bag ]] || fail "name a folder for the bag (panvo record --help)" 2
  local system
  system=$(system_file record)
  start_program panvo_run "$system" "output:=$bag" "topics:=$topics" "exclude:=$exclude" "${handed_on[@]}"
}
