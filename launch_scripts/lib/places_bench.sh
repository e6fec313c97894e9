# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# panvo bench places: recognises the places of a simulated drive on drives of other days and on other campuses.

source "$PANVO_SCRIPTS/lib/simulated.sh"
source "$PANVO_SCRIPTS/lib/bench_page.sh"

places_usage() {
  cat <<'EOT'
usage: panvo bench places [--quick] [--seeds S,...] [--route ROUTE] [--only NAME,...] [--out FILE]

Renders panoramas of a drive at noon in summer, whose landmarks are the library, and of drives on other days along the same route. Each panorama of
those is compared with the whole library, without a prior position. Prints a table of the share of revisits that were recognised, of errors of
position and heading, and of wrong matches, with 95 % intervals. Drives are rendered once and cached.

  --quick          one seed; about an hour of two cores
  --seeds LIST     seeds of the campuses (default: 601,602,603). With two or more, each library is also searched on the other campuses, where
                   every match is wrong
  --route ROUTE    route (default: dataset_ii, 1.4 km); see panvo simulate --help
  --only NAMES     of the conditions: hour, night, rain, bare, snow, rows, twins, car_parks, hall (default: all)
  --out FILE       the page (default: runs/places.md)
EOT
}

# place_condition NAME: options of panvo_simulate for the drive of another day, one per line.
place_condition() {
  case $1 in
    noon) printf '%s\n' --hour 12 ;;
    hour) printf '%s\n' --hour 17 --day 1 ;;
    night) printf '%s\n' --night --day 200 ;;
    rain) printf '%s\n' --overcast --effects rain,smear,movers --day 2 ;;
    bare) printf '%s\n' --season bare --day 120 ;;
    snow) printf '%s\n' --season snow --day 150 ;;
    rows | twins | car_parks) printf '%s\n' --layout "$1" --hour 12 --day 3 ;;
    hall) printf '%s\n' --layout hall --day 3 ;;
    *_library) printf '%s\n' --layout "${1%_library}" ;;
  esac
}

# library_of NAME: the condition of the drive whose landmarks are the library.
library_of() {
  case $1 in
    rows | twins | car_parks | hall) printf '%s_library\n' "$1" ;;
    *) printf 'noon\n' ;;
  esac
}

# place_drive ROUTE SEED CONDITION: path of the data set of that drive.
place_drive() {
  local route
  local -a options
  route=$(route_file "$1")
  mapfile -t options < <(place_condition "$3")
  rendered_dataset "$(basename "$route" .yaml)-panoramas-$3-seed$2" --route "$route" --cameras panorama --seed "$2" "${options[@]}"
}

bench_places() {
  local route=dataset_ii list=601,602,603 only=hour,night,rain,bare,snow,rows,twins,car_parks,hall out=$PANVO_HOME/runs/places.md seed other name label library query
  local -a seeds names libraries pairs=()
  while (($#)); do
    case $1 in
      -h | --help)
        places_usage
        return
        ;;
      --quick) list=601 ;;
      --seeds | --route | --only | --out)
        require_value "$@"
        case $1 in
          --seeds) list=$2 ;;
          *) printf -v "${1#--}" '%s' "$2" ;;
        esac
        shift
        ;;
      *) unknown_option "$1" ;;
    esac
    shift
  done
  split_seeds "$list"
  IFS=, read -r -a names <<<"$only"
  for name in "${names[@]}"; do
    [[ $name == @(hour|night|rain|bare|snow|rows|twins|car_parks|hall) ]] ||
      fail "--only '$name': choose from hour, night, rain, bare, snow, rows, twins, car_parks, hall" 2
  done
  prepare_page "$out"
  for seed in "${seeds[@]}"; do
    for name in "${names[@]}"; do
      library=$(place_drive "$route" "$seed" "$(library_of "$name")")
      query=$(place_drive "$route" "$seed" "$name")
      pairs+=(--pair "$name" "$library" "$query")
    done
    for other in "${seeds[@]}"; do
      [[ $other != "$seed" ]] || continue
      mapfile -t libraries < <(for name in "${names[@]}"; do library_of "$name"; done | sort -u)
      for name in "${libraries[@]}"; do
        library=$(place_drive "$route" "$seed" "$name")
        query=$(place_drive "$route" "$other" "$name")
        label=elsewhere
        [[ $name == noon ]] || label+=", ${name%_library}"
        pairs+=(--pair "$label" "$library" "$query")
      done
    done
  done
  exec python3 -B "$PANVO_HOME/tests/benchmarks/places.py" "${pairs[@]}" --programs "$(build_folder)/panvo_bin" \
    --work "$PANVO_HOME/runs/places_bench" --out "$out" --version-text "$(panvo_version)"
}
