# shellcheck shell=bash
# What ./dev shows of a build: a bar on a terminal, elsewhere a line for each tenth. ./dev sources this file and has say().

# Runs a command and shows its progress. All that it prints goes to build/log.txt, whose end is shown if it fails. A
# machine of CI gets everything at once, as nobody can look into the file there.
briefly() {
  if [[ ${CI:-} == true ]]; then
    "$@"
    return
  fi
  local log=build/log.txt status
  mkdir -p build
  set +e
  (
    set -e
    "$@"
  ) 2>&1 | tee "$log" | show_progress
  status=${PIPESTATUS[0]}
  set -e
  ((status == 0)) && return
  tail -n 40 "$log" >&2
  say "the build failed; all its lines are in $log"
  return "$status"
}

# Reads what a build prints. Lines of ./dev and warnings of the compiler are shown as they are.
show_progress() {
  local line done=0 all=0 tenth=0 clear='' bar
  [[ ! -t 2 ]] || clear=$'\r\e[K'
  while IFS= read -r line; do
    if [[ $line == 'dev: '* || $line == *' warning: '* || $line == *' error: '* ]]; then
      printf '%s%s\n' "$clear" "$line" >&2
    elif [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] && ((BASH_REMATCH[2] > 2)); then
      done=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
      if [[ -n $clear ]]; then
        printf -v bar '%*s' $((done * 40 / all)) ''
        printf '%sbuilding [%-40s] %d of %d steps, %d:%02d min' "$clear" "${bar// /#}" "$done" "$all" $((SECONDS / 60)) \
          $((SECONDS % 60)) >&2
      elif ((done * 10 / all > tenth)); then
        tenth=$((done * 10 / all))
        say "built $done of $all steps"
      fi
    fi
  done
  [[ -z $clear ]] || printf '%s' "$clear" >&2
}
