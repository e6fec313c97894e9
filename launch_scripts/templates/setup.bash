# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Source this file to use an installed panvo: adds its command to PATH and its packages to CMAKE_PREFIX_PATH. In a colcon workspace, source
# install/setup.bash instead.
_panvo_prefix=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
export PATH="$_panvo_prefix/bin${PATH:+:$PATH}"
export CMAKE_PREFIX_PATH="$_panvo_prefix${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}"
unset _panvo_prefix
