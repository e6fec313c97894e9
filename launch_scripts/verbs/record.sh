# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: record topics into a bag

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo record BAG [TOPIC...] [--exclude TOPIC] [--no-images] [--max-bag-duration S] [--overwrite] [option of panvo run ...]

Records topics into the rosbag2 folder BAG until Ctrl-C. TOPIC is a name or a regular expression that must match the whole
name, such as '/stereo/.*'; default: all topics.

  --exclude TOPIC      do not record this topic
  --no-images          do not record sensor_msgs/Image and CompressedImage
  --storage NAME       sqlite3 (.db3 files) or mcap
  --compression NAME   none, lz4 or zstd; lz4 and zstd imply mcap
  --overwrite          replace an existing bag
  --max-bag-size B     start the next file of the bag at this size, bytes
  --max-bag-duration S start the next file after this recorded time, seconds
  --max-bag-files N    keep the latest N files and remove older ones: a bag that always holds the latest time and never fills the
                       disk; needs one of the two limits above
  --start-paused       record nothing before /rosbag2_recorder/resume is called

The services of rosbag2's recorder control it: /rosbag2_recorder/pause, resume, is_paused and split_bagfile.
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
      --max-bag-size)
        require_value "$@"
        [[ $2 =~ ^[0-9]+$ ]] || fail "--max-bag-size $2: give a number of bytes" 2
        handed_on+=("max_file_mb:=$((10#$2 / 1000000)).$(printf '%06d' $((10#$2 % 1000000)))")
        shift
        ;;
      --max-bag-duration)
        require_value "$@"
        handed_on+=("max_file_s:=$2")
        shift
        ;;
      --max-bag-files)
        require_value "$@"
        handed_on+=("max_files:=$2")
        shift
        ;;
      --start-paused) handed_on+=(start_paused:=true) ;;
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
