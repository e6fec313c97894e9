# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: public recordings: list them, unpack and check a download

verb_usage() {
  cat <<'EOT'
usage: panvo data                                        list public recordings: sensors, source, licence, size, command
       panvo data prepare ARCHIVE... [--out DIR]         unpack downloaded archives, then check
       panvo data prepare DIR [--out DIR]                the same for all archives in DIR; without archives only the check
       panvo data check DIR                              check the recordings in DIR and print the commands that run them

Nothing is downloaded. `prepare` recognises the archives (zip, tar) of the data sets that panvo reads, requires enough free space, and
writes only into the folder of --out (default: a new folder named after the first archive). `check` compares images, times, calibration and
ground truth: missing, surplus and truncated files, counts, sizes, stamps. Exit status 0: everything can be played; 1: there are problems,
or a conversion is needed; 2: wrong usage.
EOT
}

verb_main() {
  command -v python3 >/dev/null || fail "python3 is missing; install the package python3"
  exec python3 -B "$PANVO_SCRIPTS/lib/data" "$@"
}
