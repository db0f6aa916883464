#!/usr/bin/env bash
# judge_recipe.sh URSULA WORK MACHINE FORMAT SOLVER CODE PATTERN: asks a solver process for the efforts of a motion, line
# by line, and has its answers judged as a file. A whole validation asks for some 200 times as many: WHOLE=1.
#
# MACHINE is a scenario's file, or a kind of leg. For a kind, `ursula init` writes the machine; its motion takes a fifth of
# the time, so that replays need fewer steps, and TILTED=1 tilts the platform during all of it. @MODEL@ in SOLVER is the
# machine exported in FORMAT. The output must match PATTERN, and the exit code must be CODE: the solver's if it fails,
# otherwise the program's.
set -euo pipefail
ursula=$1 work=$2 machine=$3 format=$4 solver=$5 expected=$6 pattern=$7

rm -rf "$work"
mkdir -p "$work"
cd "$work"
if [[ -f $machine ]]; then cp "$machine" my.toml; else "$ursula" init my.toml --kind "$machine" >/dev/null; fi
sed -i 's/time = 1.5/time = 0.3/; s/time = 3.0/time = 0.6/' my.toml
if [[ -n ${TILTED:-} ]]; then
  sed -i 's/orientation = \[1.0, 0.0, 0.0, 0.0\]/orientation = [0.9848, 0.1736, 0.0, 0.0]/
          s/orientation = \[0.9962, 0.0, 0.0, 0.0872\]/orientation = [0.9848, 0.0868, 0.1228, 0.0868]/' my.toml
fi
[[ -z ${WHOLE:-} ]] || printf '\n[simulation]\nsamples = 11\n' >>my.toml
[[ -z $format ]] || "$ursula" export my.toml --format "$format" --out "my.$format" >/dev/null

judge() {
  local motion command=${solver//@MODEL@/$work/my.$format}
  [[ -z ${WHOLE:-} ]] || { "$ursula" validate my.toml --solver "$command" --solver-timeout 60 --quiet; return; }
  motion=$("$ursula" inverse my.toml --samples 101) || return
  tail -n +2 <<<"$motion" | cut -d, -f1-20 | URSULA_SCENARIO=$work/my.toml sh -c "$command" >answers || return
  (($(wc -l <answers) == 101)) || { echo "$(wc -l <answers) answers to 101 lines"; return 3; }
  {
    head -1 <<<"$motion" | tr , '\n' | grep -E '^(t_s|tau_.*)$' | paste -sd,
    paste -d, <(tail -n +2 <<<"$motion" | cut -d, -f1) answers
  } >answers.csv
  "$ursula" validate my.toml --torques answers.csv --out results
}

code=0
output=$(judge 2>&1) || code=$?
echo "$output"
[[ $code == "$expected" && $output =~ $pattern ]] || { echo "exit code $code, expected $expected and output that matches $pattern"; exit 1; }
