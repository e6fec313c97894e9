#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh BUILD modules|browser|figures: runs the tests, or measurements, of the page that was built in BUILD. Exits with 77 and the reason if
# they cannot run.
set -euo pipefail

cd "$1"
if ! [[ -f dist/index.html ]] || ! command -v node >/dev/null; then
  echo "skipped: the page was not built, because node, npm or their packages are missing (see the target panvo_page)"
  exit 77
fi
if [[ $2 != modules ]]; then
  CHROMIUM=$(command -v chromium || command -v google-chrome || true)
  export CHROMIUM
  if [[ -z $CHROMIUM ]]; then
    echo "skipped: chromium is not installed (Debian: apt install chromium)"
    exit 77
  fi
  if ! [[ -x ${PANVO_RUN:-} ]]; then
    echo "skipped: panvo_run was not built"
    exit 77
  fi
fi
exec node test/run.mjs "$2"
