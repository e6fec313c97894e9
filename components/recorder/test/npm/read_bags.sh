#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# read_bags.sh FOLDER BAGS: runs read_bags.mjs where its packages are. 77 where they are not.
set -euo pipefail

if [[ ! -d $1/node_modules ]] || ! command -v node >/dev/null; then
  echo "skipped: node or the witnesses' packages are not here, see the test that installs them"
  exit 77
fi
cd "$1"
exec node read_bags.mjs "$2"
