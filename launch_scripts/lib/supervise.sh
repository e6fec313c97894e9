# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# For verbs that start one program after another: a signal to the verb ends all of them.

# supervise FUNCTION ARGUMENT...: runs it in a process group of its own, passes SIGINT, SIGTERM and SIGHUP on to the whole group, and returns when
# none of it is left. The exit status is the function's, or 128 + the signal.
supervise() {
  local worker ended_by='' status=0
  set -m  # or the group would be ours, and SIGINT ignored in it
  ("$@") &
  worker=$!
  set +m
  trap 'ended_by=INT; kill -INT -- "-$worker" 2>/dev/null' INT
  trap 'ended_by=TERM; kill -TERM -- "-$worker" 2>/dev/null' TERM
  trap 'ended_by=HUP; kill -TERM -- "-$worker" 2>/dev/null' HUP
  wait "$worker" || status=$?
  if [[ -n $ended_by ]]; then
    wait_for_group "$worker"
    note "ended by SIG$ended_by"
    status=$((128 + $(kill -l "$ended_by")))
  fi
  trap - INT TERM HUP
  return "$status"
}

# wait_for_group ID: until none of its processes lives; those that are left after half a minute (a run takes 20 s at most) are killed.
wait_for_group() {
  local give_up=$((SECONDS + 30))
  while ((SECONDS < give_up)); do
    group_lives "$1" || return 0
    sleep 0.1
  done
  kill -KILL -- "-$1" 2>/dev/null || true
}

# group_lives ID: whether a process of the group is more than a zombie.
group_lives() {
  local file line
  local -a fields
  for file in /proc/[0-9]*/stat; do
    { read -r line <"$file"; } 2>/dev/null || continue
    read -r -a fields <<<"${line##*) }"  # state, parent, group
    [[ ${fields[2]} != "$1" || ${fields[0]} == Z ]] || return 0
  done
  return 1
}
