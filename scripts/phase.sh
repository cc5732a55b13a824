# shellcheck shell=bash
# Phases: one thing done, its output kept in build/logs, its time and its verdict on one line.
# Sourced by ./pleat, which sets $root and opens descriptor 3 for what a person reads.

passed=0
failed=0

say() { printf '%s\n' "$*" >&3; }

give_up() {
  say "$*"
  exit 1
}

# Gives up on a command line that cannot be understood.
bad_usage() {
  say "pleat: $*"
  exit 2
}

# The last "[57/222]" of a log.
progress_in() { tail -n 20 "$1" | sed -n 's/^\[\([0-9]\+\/[0-9]\+\)\].*/\1/p' | tail -n 1; }

# Shows how far a running phase is until it is killed or ./pleat ends.
show_progress() {
  local what=$1 log=$2
  while sleep 0.5 && kill -0 $$ 2>/dev/null; do
    printf '\r%-46s %s' "$what" "$(progress_in "$log")" >&3
  done
}

# phase NAME "what it does" COMMAND…: runs COMMAND in the repository; its status is the phase's.
phase() {
  local name=$1 what=$2 status=0 start=$SECONDS log watcher=''
  shift 2
  log=build/logs/$name.log
  mkdir -p "$root/build/logs"
  printf '%-46s ' "$what" >&3
  : >"$root/$log"
  if [ -t 3 ]; then
    show_progress "$what" "$root/$log" &
    watcher=$!
  fi
  (cd "$root" && "$@") >"$root/$log" 2>&1 </dev/null || status=$?
  if [ -n "$watcher" ]; then
    kill "$watcher" && wait "$watcher" 2>/dev/null
    printf '\r\e[K%-46s ' "$what" >&3
  fi
  if [ "$status" -eq 0 ]; then
    say "$((SECONDS - start)) s"
  else
    say "failed after $((SECONDS - start)) s; the end of $log:"
    tail -n 40 "$root/$log" | sed 's/^/  | /' >&3
  fi
  return "$status"
}

# step NAME "what" COMMAND…: a phase the later ones build on; only its failure is counted.
step() {
  phase "$@" && return
  failed=$((failed + 1))
  return 1
}

# check NAME "what" COMMAND…: a phase that counts as one.
check() {
  step "$@" || return 1
  passed=$((passed + 1))
}

# suite READER NAME "what" COMMAND…: a phase whose log says how many passed and failed. READER turns
# the log into "PASSED FAILED". A suite that breaks off, or runs nothing, counts as one failure.
suite() {
  local reader=$1 name=$2 status=0 counts n_passed n_failed
  shift
  phase "$@" || status=$?
  counts=$("$reader" <"$root/build/logs/$name.log")
  read -r n_passed n_failed <<<"${counts:-0 0}"
  if [ "$n_failed" -eq 0 ] && { [ "$status" -ne 0 ] || [ "$n_passed" -eq 0 ]; }; then
    n_failed=1
  fi
  say "  $n_passed passed, $n_failed failed (build/logs/$name.log)"
  passed=$((passed + n_passed))
  failed=$((failed + n_failed))
  [ "$n_failed" -eq 0 ]
}

# meanwhile COMMAND…: runs phases beside those that follow, which go before them. One at a time.
meanwhile() {
  mkdir -p "$root/build/logs"
  rm -f "$root/build/logs/meanwhile.counts"
  set -m # a process group of its own, which an interrupt ends as well
  (
    exec 3>"$root/build/logs/meanwhile.log"
    renice -n 10 -p "$BASHPID" >/dev/null
    passed=0
    failed=0
    "$@"
    echo "$passed $failed" >"$root/build/logs/meanwhile.counts"
  ) &
  meanwhile_pid=$!
  set +m
  trap 'kill -- "-$meanwhile_pid"; exit 130' INT TERM
}

# rejoin: waits for them, shows their lines and counts what they counted; one failure when they broke off.
rejoin() {
  local n_passed=0 n_failed=1 lines=$root/build/logs/meanwhile.log
  while [ -t 3 ] && kill -0 "$meanwhile_pid" 2>/dev/null; do
    # shellcheck disable=SC2012
    printf '\r\e[K%s%s' "$(tail -n 1 "$lines")" "$(progress_in "$(ls -t "$root"/build/logs/*.log | head -n 1)")" >&3
    sleep 0.5
  done
  wait "$meanwhile_pid"
  trap - INT TERM
  [ ! -t 3 ] || printf '\r\e[K' >&3
  cat "$lines" >&3
  [ ! -f "$root/build/logs/meanwhile.counts" ] || read -r n_passed n_failed <"$root/build/logs/meanwhile.counts"
  passed=$((passed + n_passed))
  failed=$((failed + n_failed))
}

# Catch2's console reporter ends with "All tests passed (7 assertions in 3 test cases)" or
# "test cases: 3 | 2 passed | 1 failed"; sums over the programs whose outputs are in the log. One that
# finds no test to run says "No tests ran" and counts as a failure.
read_catch2() {
  awk '
    /^All tests passed \(/ { match($0, /in [0-9]+ test case/); good += substr($0, RSTART + 3) }
    /^No tests ran/ { bad++ }
    /^test cases: / {
      for (i = 3; i < NF; i++) {
        if ($(i + 1) == "passed") good += $i
        if ($(i + 1) == "failed" && $(i + 2) != "as") bad += $i
      }
    }
    END { print good + 0, bad + 0 }'
}

# Vitest ends with "Tests  1 failed | 8 passed | 2 skipped (11)". Everything a test could need has been
# built by then, so a skipped one is a failure.
read_vitest() {
  sed 's/\x1b\[[0-9;]*m//g' | awk '
    $1 == "Tests" {
      good = bad = 0
      for (i = 2; i < NF; i++) {
        if ($(i + 1) == "passed") good = $i
        if ($(i + 1) == "failed" || $(i + 1) == "skipped") bad += $i
      }
      print good, bad
    }' | tail -n 1
}

# The page's own checks end with "8 passed, 1 failed".
read_summary() {
  sed -n 's/^\([0-9]\+\) passed, \([0-9]\+\) failed$/\1 \2/p' | tail -n 1
}
