#!/usr/bin/env bash
# tools/fresh.sh [--suite SUITE] [--tests] [ARGUMENT…]: tries ./dev validate as a newcomer would, in a clean clone of HEAD in
# an empty Debian 12 or SUITE, which is made and removed here. With --tests it builds and runs the core's tests there, too.
# It prints the time taken and the packages added, and fails for a warning. It needs root, debootstrap and some 2 GB
# below TMPDIR, and takes some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
suite=bookworm tests=()
if [[ ${1:-} == --suite ]]; then suite=${2:?SUITE} && shift 2; fi
if [[ ${1:-} == --tests ]]; then
  tests=(base_tests model_tests nocsolver_tests simbody_loop_tests validation_tests) && shift
fi

say() { printf 'fresh: %s\n' "$*" >&2; }

if ((EUID != 0)) || ! unshare --mount true; then
  say 'an empty system is made by root, with a mount namespace of its own'
  exit 2
fi
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
root=$work/root

# shellcheck source=/dev/null
host=$(. /etc/os-release && echo "${VERSION_CODENAME:-$suite}")
# Returns the host's own mirror, which has its neighbours, too.
mirror() {
  # shellcheck disable=SC2016  # the dollars are apt's
  apt-get indextargets --format '$(CODENAME) $(REPO_URI)' 'Created-By: Packages' |
    sed -nE "s/^($suite|$host) //p" | head -n 1
}
proxy=$(apt-config dump --format '%v' Acquire::http::Proxy)
[[ -z $proxy ]] || export http_proxy=$proxy

# The host's way to its mirrors; its sources only for its own suite.
share_apt() {
  local part parts=(apt.conf.d trusted.gpg.d keyrings auth.conf.d)
  [[ $suite != "$host" ]] || parts+=(sources.list sources.list.d preferences.d)
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  for part in "${parts[@]}"; do
    [[ ! -e /etc/apt/$part ]] || cp -a "/etc/apt/$part" "$root/etc/apt/"
  done
  cp -an /usr/share/keyrings/. "$root/usr/share/keyrings/"
  mkdir -p "$root/etc/ssl/certs"
  [[ ! -e /etc/ssl/certs/ca-certificates.crt ]] || cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
}

# shellcheck disable=SC2016  # expanded in there
inside() { unshare --mount sh -c 'mount -t proc proc "$0/proc" && exec chroot "$0" "$@"' "$root" "$@"; }

# shellcheck disable=SC2016  # the dollars are dpkg's
packages() { inside dpkg-query -W -f='${Package} ${Installed-Size}\n' | sort; }

say 'making an empty system'
if [[ -z $(mirror) ]]; then apt-get update -q >&2; fi
debootstrap --variant=minbase "$suite" "$root" "$(mirror)" >"$work/log" 2>&1 || { tail "$work/log" >&2; exit 2; }
share_apt
git clone -q --no-hardlinks . "$root/ursula"
packages >"$work/before"

say './dev validate in there'
started=$SECONDS status=0
newcomer() {
  inside env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
    ${http_proxy:+http_proxy="$http_proxy"} "$@" </dev/null
}
newcomer /ursula/dev validate "$@" >"$work/out" 2>"$work/err" || status=$?
took=$((SECONDS - started))
((status == 0)) || tail -n 30 "$work/err" >&2
packages >"$work/after"
unpacked=$(du -sm "$root/ursula/.deps" 2>/dev/null | cut -f 1)
comm -13 "$work/before" "$work/after" |
  awk -v unpacked="${unpacked:-0}" -v took="$took" -v status="$status" '
    { sum += $2 / 1024; count++ }
    END { printf "fresh: exit %d after %d s; %d packages added, %d MB, and %d MB unpacked: %d MB in all\n",
                 status, took, count, sum, unpacked, sum + unpacked }'
printf 'fresh: last line: %s\n' "$(tail -n 1 "$work/out")"
if ((${#tests[@]} && status == 0)); then
  # shellcheck disable=SC2016  # expanded in there
  newcomer bash -c 'cd /ursula && apt-get install -y -q --no-install-recommends libgtest-dev libgmock-dev &&
    cmake build -DURSULA_TESTS=ON && cmake --build build --target "$@" && for each; do
      "$(find build/tests -name "$each" -type f)" --gtest_brief=1 || exit; done' tests "${tests[@]}" >"$work/tests" 2>&1 || status=$?
  tail -n "$((status == 0 ? 1 : 30))" "$work/tests"
fi
if grep -hE -A 3 'warning: |^CMake Warning' "$work/out" "$work/err" "$work/tests" 2>/dev/null; then
  say 'the build has warnings'
  status=1
fi
exit "$status"
