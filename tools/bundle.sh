#!/usr/bin/env bash
# Builds the report's script and style from their sources and the lock file, with npm.
#
#   tools/bundle.sh           writes report/web/bundle
#   tools/bundle.sh --check   fails unless that folder holds the very bytes; 77 if npm's registry does not answer
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
web=report/web

if grep -l '"resolved"' "$web"/package-lock.json tests/browser/package-lock.json; then
  echo 'bundle: a lock file records where packages were downloaded from; remove its "resolved" lines' >&2
  exit 1
fi

# npm and esbuild look for packages beside the sources, so they work on a copy and the source tree stays clean.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$web"/*.* "$web"/.npmrc "$work"
if ! (cd "$work" && npm ci --ignore-scripts --no-audit --no-fund --prefer-offline --loglevel=error >&2); then
  echo 'bundle: npm could not install what package-lock.json names' >&2
  exit 77
fi
node "$work/build.mjs" "$work/bundle"

if [[ ${1:-} != --check ]]; then
  rm -rf "$web/bundle"
  cp -r "$work/bundle" "$web/bundle"
elif ! diff -rq "$web/bundle" "$work/bundle" >&2; then
  echo "bundle: $web/bundle is not what its sources and package-lock.json make: run ./dev bundle and commit the result" >&2
  exit 1
fi
