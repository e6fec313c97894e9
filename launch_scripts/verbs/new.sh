# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: create a component package with messages, tests and a system file

verb_usage() {
  cat <<'EOT'
usage: panvo new component NAME [--in FOLDER]

Creates the package FOLDER/NAME (default: ./NAME), which builds, runs and passes its tests: a component with algorithm, message, service and
parameter, tests, and a system file that runs it after stereo odometry. Its README describes how to build it with colcon or cmake.

NAME is the package name: lower-case letters, digits and '_', as in ROS 2. Existing files are never overwritten.
EOT
}

# Template in templates/component, and the file created from it.
component_files=(
  "CMakeLists.txt|CMakeLists.txt"
  "package.xml|package.xml"
  "README.md|README.md"
  "Distance.msg|msg/Distance.msg"
  "Reset.srv|srv/Reset.srv"
  "topics.hpp|include/@name@/topics.hpp"
  "algorithm.hpp|include/@name@/@name@.hpp"
  "algorithm.cpp|src/@name@.cpp"
  "component.cpp|src/@name@_component.cpp"
  "algorithm_test.cpp|test/@name@_test.cpp"
  "component_test.cpp|test/@name@_component_test.cpp"
  "system.yaml|config/@name@.yaml"
)

verb_main() {
  [[ ${1:-} == component ]] || fail "'${1:-}' cannot be created; 'panvo new component NAME' creates a component" 2
  shift
  local name='' folder=$PWD
  while (($#)); do
    case $1 in
      --in)
        require_value "$@"
        folder=$2
        shift
        ;;
      -*) unknown_option "$1" ;;
      *)
        [[ -z $name ]] || fail "only one name is allowed: '$name' or '$1'?" 2
        name=$1
        ;;
    esac
    shift
  done
  [[ -n $name ]] || fail "name the package: panvo new component NAME" 2
  [[ $name =~ ^[a-z][a-z0-9]*(_[a-z0-9]+)*$ ]] ||
    fail "'$name' is not a package name: use lower-case letters, digits and single '_', starting with a letter (my_filter)" 2
  [[ -d $folder ]] || fail "folder '$folder' not found" 2
  [[ -d $PANVO_SCRIPTS/templates ]] || fail "the templates are missing; install the package libpanvo-dev"
  [[ ! -e $folder/$name ]] || fail "$folder/$name already exists; choose another name or folder"
  create_component "$name" "$folder/$name"
  note "created $folder/$name; its README.md says how to build and run it"
}

# create_component NAME FOLDER
create_component() {
  local name=$1 folder=$2 class entry target
  class=$(pascal_case "$name")
  for entry in "${component_files[@]}"; do
    target=$folder/${entry#*|}
    target=${target//@name@/$name}
    mkdir -p "${target%/*}"
    sed -e "s/@name@/$name/g" -e "s/@Class@/$class/g" "$PANVO_SCRIPTS/templates/component/${entry%|*}.in" >"$target" ||
      fail "cannot write $target"
  done
}

# pascal_case my_filter: MyFilter.
pascal_case() {
  local word
  for word in ${1//_/ }; do printf '%s' "${word^}"; done
}
