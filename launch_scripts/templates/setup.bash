# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Source this file to use an installed panvo: adds its command to PATH, its packages to CMAKE_PREFIX_PATH and its Python module to PYTHONPATH. In
# a colcon workspace, source install/setup.bash instead.
_panvo_prefix=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
export PATH="$_panvo_prefix/bin${PATH:+:$PATH}"
export CMAKE_PREFIX_PATH="$_panvo_prefix${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}"
for _panvo_module in "$_panvo_prefix"/lib/python3*/*-packages/panvo; do
  [[ ! -d $_panvo_module ]] || export PYTHONPATH="${_panvo_module%/panvo}${PYTHONPATH:+:$PYTHONPATH}"
done
unset _panvo_prefix _panvo_module
