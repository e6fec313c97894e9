#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# install.sh FOLDER: installs the third-party readers into FOLDER. Exits with 77 and the reason if that is not possible.
set -euo pipefail

folder=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if ! command -v npm >/dev/null || ! command -v node >/dev/null; then
  echo "skipped: npm and node are not installed (Debian: apt install nodejs npm)"
  exit 77
fi
mkdir -p "$folder"
cp "$here/package.json" "$here/read_bags.mjs" "$folder"
if [[ $folder/node_modules -nt $here/package.json ]]; then
  exit 0
fi
if ! timeout 100 npm install --prefix "$folder" --no-audit --no-fund --ignore-scripts; then
  echo "skipped: the packages could not be installed; is there a network?"
  exit 77
fi
touch "$folder/node_modules"
