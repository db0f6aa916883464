#!/usr/bin/env bash
# tools/thread_tbb.sh FOLDER: installs oneTBB under the thread sanitizer there, from Debian's source of it. TBB
# synchronises by its own atomics; if the sanitizer does not see these, every task looks like a race.
set -euo pipefail
prefix=$(realpath -m "${1:?a folder}")
[[ ! -e $prefix/lib/libtbb.so ]] || exit 0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{parts,lists/partial,source}
# Sources come from where this machine's packages come from. The machine's own lists do not change.
for list in /etc/apt/sources.list.d/*.sources; do
  if grep -qs debian-archive "$list"; then sed 's/^Types:.*/Types: deb-src/' "$list" >"$work/parts/$(basename "$list")"; fi
done
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
  [[ ! -e $list ]] || sed -nE '/debian/s/^deb /deb-src /p' "$list" >>"$work/parts/old.list"
done
there=(-q -o APT::Sandbox::User=root -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work/parts"
  -o Dir::State::Lists="$work/lists")
apt-get "${there[@]}" update >&2
(cd "$work/source" && apt-get "${there[@]}" source onetbb >&2)
cmake -S "$work"/source/onetbb-* -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib -DTBB_SANITIZE=thread -DTBB_TEST=OFF \
  -DTBBMALLOC_BUILD=OFF -DTBB_STRICT=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON >&2
cmake --build "$work/build" --target install >&2
