# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# For commands that start several programs: a signal to the command ends all of them, and its end those in the background.

# supervise FUNCTION ARGUMENT...: runs the function in its own process group and forwards SIGINT, SIGTERM and SIGHUP (as SIGTERM) to the group. After
# a signal, and when the function has ended, waits until the group has ended. The exit status is that of the function, or 128 + the signal.
supervise() {
  local worker='' ended_by='' status=0
  trap 'ended_by=INT; end_group INT "$worker"' INT
  trap 'ended_by=TERM; end_group TERM "$worker"' TERM
  trap 'ended_by=HUP; end_group TERM "$worker"' HUP
  set -m  # without it the job would share our group and ignore SIGINT
  ("$@") &
  worker=$!
  set +m
  [[ -z $ended_by ]] || end_group TERM "$worker"  # it may have come before there was a group
  wait "$worker" || status=$?
  [[ -n $ended_by ]] || end_group TERM "$worker"  # a rendering goes on in the background when the build beside it fails
  wait_for_group "$worker"
  if [[ -n $ended_by ]]; then
    note "ended by SIG$ended_by"
    status=$((128 + $(kill -l "$ended_by")))
  fi
  trap - INT TERM HUP
  return "$status"
}

# end_group SIGNAL ID: ID may be empty.
end_group() { [[ -z $2 ]] || kill "-$1" -- "-$2" 2>/dev/null || true; }

# wait_for_group ID: waits until all processes of the group have ended; kills the rest after 30 s (a run needs 20 s at most to stop).
wait_for_group() {
  local give_up=$((SECONDS + 30))
  while ((SECONDS < give_up)); do
    group_lives "$1" || return 0
    sleep 0.1
  done
  kill -KILL -- "-$1" 2>/dev/null || true
}

# group_lives ID: whether the group has a process that is not a zombie.
group_lives() {
  local file line
  local -a fields
  for file in /proc/[0-9]*/stat; do
    { read -r line <"$file"; } 2>/dev/null || continue
    read -r -a fields <<<"${line##*) }"  # state, parent, group
    [[ ${fields[2]:-} != "$1" || ${fields[0]} == Z ]] || return 0  # none: a name with a line break
  done
  return 1
}
