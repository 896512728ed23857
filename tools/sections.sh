# Sourced by .ci/run and tools/check-all: `section TITLE COMMAND...` runs a command under a heading with the seconds it took;
# the first that fails ends the script. `section_before MINUTES TITLE COMMAND...` leaves it out, and says so, where the
# script has run for longer. `sections_done` repeats the headings and what ctest said.
section_lines=()
section() {
  local title=$1 before=$SECONDS log status=0
  shift
  log=$(mktemp)
  printf '\n======== %s\n' "$title"
  "$@" 2>&1 | tee "$log" || status=$?
  section_lines+=("$(printf '%5d s  %s%s' $((SECONDS - before)) "$title" "$(grep -E 'tests (passed|failed)' "$log" | sed 's/^/: /' | tail -n 1)")")
  rm -f "$log"
  printf '======== %s: %d s\n' "$title" $((SECONDS - before))
  [ $status -eq 0 ] || { sections_done; printf '\nFAILED: %s\n' "$title"; exit 1; }
}
section_before() {
  local minutes=$1
  shift
  if [ "$SECONDS" -lt $((minutes * 60)) ]; then
    section "$@"
    return
  fi
  section_lines+=("LEFT OUT  $1: $minutes minutes were over; run ${*:2}")
  printf '\n======== LEFT OUT: %s; run %s\n' "$1" "${*:2}"
}
sections_done() {
  printf '\n======== all so far, %d s\n' "$SECONDS"
  printf '%s\n' "${section_lines[@]}"
}
