#!/usr/bin/env bash
# Runs the browser tests. Their npm packages are installed first, beside the build.
# usage: run.sh SAMPLES_DIR WORK_DIR [CHROMIUM]
# Exits with 77 (ctest: skipped) if npm's registry does not answer; in CI that is a failure.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
samples=$1 work=$2 chromium=${3:-}

if ! cmp -s "$here/package-lock.json" "$work/installed.json"; then
  mkdir -p "$work" && cp "$here"/package*.json "$here/.npmrc" "$work" || exit 1
  if ! (cd "$work" && npm ci --ignore-scripts --no-audit --no-fund --prefer-offline --loglevel=error); then
    echo 'report.browser did NOT run: npm could not install playwright-core'
    [[ ${CI:-} == true ]] && exit 1
    exit 77
  fi
  cp "$here/package-lock.json" "$work/installed.json" || exit 1
fi
status=0
for test in report pages view; do
  node "$here/../validation/${test}_browser_test.mjs" "$samples" "$work" "$chromium" || status=$?
done
exit "$status"
