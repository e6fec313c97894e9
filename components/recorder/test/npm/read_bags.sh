#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# read_bags.sh FOLDER BAGS: runs read_bags.mjs in FOLDER, which holds its packages. Exits with 77 if they are missing.
set -euo pipefail

if [[ ! -d $1/node_modules ]] || ! command -v node >/dev/null; then
  echo "skipped: node or the npm packages are missing, see the test bag_witnesses.Install"
  exit 77
fi
cd "$1"
exec node read_bags.mjs "$2"
