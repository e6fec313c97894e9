#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# build.sh SOURCE BUILD: builds the page into BUILD/dist. If node, npm or their packages cannot be had, says so and succeeds without it.
set -euo pipefail

source=$1 build=$2

leave_out() {
  rm -rf "$build/dist"
  echo "The page of 'panvo view' is left out: $1."
  exit 0
}

for program in node npm; do
  command -v "$program" >/dev/null || leave_out "$program is not installed (panvo setup page)"
done
mkdir -p "$build"
cd "$build"
rm -rf src styles test dist built
cp -r "$source"/. .
if ! cmp -s package-lock.json node_modules/.installed_lock; then
  timeout 300 npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=0 --fetch-timeout=20000 >npm.log 2>&1 ||
    leave_out "its npm packages could not be installed; is there a network? (see $build/npm.log)"
  cp package-lock.json node_modules/.installed_lock
fi
npm run --silent check
npm run --silent build
touch built
