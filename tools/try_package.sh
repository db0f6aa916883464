#!/usr/bin/env bash
# tools/try_package.sh PACKAGE.deb: installs the package into an empty Debian and validates the paper's helix there.
# Needs root and debootstrap; exits with 77 if no empty Debian can be made. Takes suite, mirrors and keys from this
# machine's own apt.
set -euo pipefail

(($# == 1)) || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
package=$(realpath "$1")
root=$(mktemp -d)
trap 'rm -rf --one-file-system "$root"' EXIT

# shellcheck source=/dev/null
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
# $(REPO_URI) is apt-get's, not the shell's.
# shellcheck disable=SC2016
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' "Codename: $suite" | head -n 1)
[[ -n $mirror ]] || { echo "try_package: apt knows no mirror of $suite; apt-get update?" >&2; exit 2; }

# The system is thrown away, so its packages need not survive a loss of power.
{
  debootstrap --foreign --variant=minbase "$suite" "$root" "$mirror" &&
    mkdir -p "$root/etc/dpkg/dpkg.cfg.d" && echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io" &&
    chroot "$root" /debootstrap/debootstrap --second-stage
} >"$root.log" 2>&1 || { tail -n 20 "$root.log" >&2; exit 77; }
rm -f "$root.log"

# The new system uses the same mirrors, keys and certificates.
for path in etc/apt etc/resolv.conf etc/hosts usr/share/keyrings usr/local/share/ca-certificates etc/ssl/certs; do
  if [[ -e /$path ]]; then
    mkdir -p "$root/$(dirname "$path")"
    cp -aL --remove-destination "/$path" "$root/$(dirname "$path")/" 2>/dev/null || true
  fi
done
cp "$package" "$root/tmp/ursula.deb"

inside() { chroot "$root" env -u LD_LIBRARY_PATH DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
inside apt-get update -q
inside apt-get install -y -q --no-install-recommends /tmp/ursula.deb
inside ursula --version
inside ursula validate /usr/share/ursula/scenarios/paper-helix.toml --out /tmp/helix
inside test -s /tmp/helix/report.html
inside sh -c 'ldconfig -p | grep -q libursula.so'
for file in share/man/man1/ursula.1 share/bash-completion/completions/ursula share/zsh/vendor-completions/_ursula \
  share/fish/vendor_completions.d/ursula.fish share/doc/ursula/copyright share/doc/ursula/examples/CMakeLists.txt include/ursula/ursula.h; do
  [[ -s $root/usr/$file || -s $root/usr/$file.gz ]] || { echo "try_package: the package has no /usr/$file" >&2; exit 1; }
done
echo "try_package: $(basename "$package") works in an empty $suite; installed there: $(du -sm "$root" | cut -f1) MB"
