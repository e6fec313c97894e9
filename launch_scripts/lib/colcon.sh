# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Builds and tests the packages one by one with colcon, as in a ROS 2 workspace. Sourced after lib/build.sh.

# colcon_bases: sets the folders of a build type. release uses those of a plain `colcon build` at the root.
colcon_bases() {
  colcon_meta=(--metas "$PANVO_HOME/colcon.meta")
  case $PANVO_BUILD in
    release)
      colcon_build_base=$PANVO_HOME/build
      colcon_install_base=$PANVO_HOME/install
      ;;
    asan | ubsan | tsan)
      colcon_build_base=$PANVO_HOME/build/colcon_$PANVO_BUILD
      colcon_install_base=$PANVO_HOME/install/$PANVO_BUILD
      colcon_meta+=("$PANVO_HOME/config/build/$PANVO_BUILD.meta")
      ;;
    *) fail "--colcon supports release, asan, ubsan and tsan; omit it for '$PANVO_BUILD'" 2 ;;
  esac
}

colcon_build() {
  ensure_packages build colcon
  colcon_bases
  cd "$PANVO_HOME" || return
  MAKEFLAGS=-j$(job_count) colcon --log-base "$PANVO_HOME/log" build --build-base "$colcon_build_base" --install-base "$colcon_install_base" \
    "${colcon_meta[@]}" --executor sequential "$@" >&2
}

# colcon_test: writes one JUnit file per package; the caller counts the results.
colcon_test() {
  cd "$PANVO_HOME" || return
  rm -f "$colcon_build_base"/panvo_*/panvo_junit.xml
  colcon --log-base "$PANVO_HOME/log" test --build-base "$colcon_build_base" --install-base "$colcon_install_base" \
    "${colcon_meta[@]}" --executor sequential --ctest-args --output-junit panvo_junit.xml "$@" >&2
}
