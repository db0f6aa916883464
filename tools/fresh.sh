#!/usr/bin/env bash
# Tries ./dev validate as a newcomer would: in a clean clone of HEAD in an empty Debian 12, which is made and removed
# here. It prints the time taken and the packages added. It needs root, debootstrap and some 2 GB below TMPDIR, and
# takes some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
suite=bookworm

say() { printf 'fresh: %s\n' "$*" >&2; }

if ((EUID != 0)) || ! unshare --mount true; then
  say 'an empty system is made by root, with a mount namespace of its own'
  exit 2
fi
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
root=$work/root

# Returns the host's own mirror.
mirror() {
  # shellcheck disable=SC2016  # the dollars are apt's
  apt-get indextargets --format '$(CODENAME) $(REPO_URI)' 'Created-By: Packages' | sed -n "s/^$suite //p" | head -n 1
}
proxy=$(apt-config dump --format '%v' Acquire::http::Proxy)
[[ -z $proxy ]] || export http_proxy=$proxy

share_apt() {
  local part
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  for part in sources.list sources.list.d apt.conf.d preferences.d trusted.gpg.d keyrings auth.conf.d; do
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
if grep -qs "VERSION_CODENAME=$suite" /etc/os-release; then share_apt; fi
git clone -q --no-hardlinks . "$root/ursula"
packages >"$work/before"

say './dev validate in there'
started=$SECONDS status=0
inside env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 ${http_proxy:+http_proxy="$http_proxy"} \
  /ursula/dev validate "$@" </dev/null >"$work/out" 2>"$work/err" || status=$?
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
exit "$status"
