# shellcheck shell=bash
# The packages that the verbs of ./dev need, and their installation. ./dev sources this file and has say().

# The needs of each verb: COMMAND:PACKAGE, where the package is installed only if the command is missing, or a library's
# package.
declare -A needs=(
  [core]='g++:g++ cmake:cmake ninja:ninja-build libeigen3-dev libcli11-dev libtomlplusplus-dev libkainjow-mustache-dev nlohmann-json3-dev libfmt-dev liblapack3 libblas3'
  [parts]='libxsimd-dev libtbb-dev libsqlite3-dev libtinyxml2-dev'
  [test]='libgtest-dev libgmock-dev python3 python3-dev python3-numpy python3-pytest pybind11-dev libopenblas0-pthread rsvg-convert:librsvg2-bin'
  [heavy]='python3-pip python3-venv patchelf:patchelf pkg-config:pkgconf octave-cli:octave node:nodejs npm:npm chromium:chromium sbatch:slurm-wlm munged:munge furo python3-myst-parser python3-sphinx'
  [core_test]='libgtest-dev libgmock-dev'
  [bench]='libbenchmark-dev'
  [format]='git:git clang-format:clang-format'
  [lint]='git:git clang-format:clang-format shellcheck:shellcheck python3:python3'
  [sanitize]='clang++:clang libclang-rt-14-dev libgtest-dev libgmock-dev dpkg-source:dpkg-dev'
  [fuzz]='clang++:clang libclang-rt-14-dev libgtest-dev libgmock-dev'
  [tidy]='libgtest-dev libgmock-dev libbenchmark-dev clang-tidy:clang-tidy python3:python3'
  [results]='git:git gnuplot:gnuplot-nox chromium:chromium python3:python3'
  [docs]='doxygen:doxygen python3:python3'
  [site]='furo python3-myst-parser python3-sphinx python3 python3-dev python3-numpy pybind11-dev chromium:chromium'
  [package]='dpkg-shlibdeps:dpkg-dev file:file python3 python3-dev python3-numpy pybind11-dev'
  [wheel]='python3 python3-dev python3-numpy python3-pytest python3-pip python3-venv pybind11-dev patchelf:patchelf'
  [bundle]='node:nodejs npm:npm'
  [fresh]='git:git debootstrap:debootstrap'
)
# Optional packages, which a verb does without if they cannot be installed: a further formulation, needed before the
# first configuration; a peer of the benchmarks; the readers of Gazebo and ROS, which check exported models; DART
# for `ursula engines`.
declare -A optional=(
  [parts]='libmujoco-dev'
  [test]='libsdformat-dev liburdfdom-dev libdart-dev'
  [bench]='libmujoco-dev libdart-dev'
)

# Only the headers of these are used, but they install some 350 MB: libsimbody-dev brings OpenGL with a compiler for it,
# and most of Boost is never used. Unless they are installed, the used parts are unpacked into .deps/, where CMake
# looks.
unpacked=(libsimbody-dev libboost-dev)
left_out=(asio beast compute geometry gil graph hana interprocess log msm phoenix polygon proto qvm spirit test thread wave
  xpressive)

# Prints those of the needed packages that are not installed.
missing() {
  local need installed=''
  if command -v dpkg-query >/dev/null; then
    installed=$(dpkg-query -W -f='${db:Status-Status}:${Package}\n' "${@#*:}" 2>/dev/null || true)
  fi
  for need in "$@"; do
    if [[ $need == *:* ]] && command -v "${need%%:*}" >/dev/null; then continue; fi
    grep -qx "installed:${need#*:}" <<<"$installed" || echo "${need#*:}"
  done
}

update_lists() {
  local as_root=()
  ((EUID == 0)) || as_root=(sudo)
  [[ -n ${lists_are_new:-} ]] || "${as_root[@]}" apt-get update -q >&2 || return
  lists_are_new=yes
}

install_packages() {
  (($#)) || return 0
  local as_root=()
  if ! command -v apt-get >/dev/null; then
    say "no apt here; needed are what Debian calls: $*"
    say "going on, as they may be there under other names"
    return 0
  fi
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      say "neither root nor sudo; missing are: $*"
      return 0
    fi
    as_root=(sudo)
  fi
  say "installing $*"
  # A machine of CI is thrown away: its packages need not survive a loss of power, and nobody reads its manuals.
  local options=()
  [[ ${CI:-} != true ]] || options=(-o DPkg::Options::=--force-unsafe-io -o 'DPkg::Options::=--path-exclude=/usr/share/man/*')
  update_lists && "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${options[@]}" "$@" >&2
}

# Unpacks the package and the packages that it stands for or links to: libboost1.74-dev, libsimbody3.7.
unpack() {
  local work deb names status=0
  say "unpacking $1"
  mapfile -t names < <(LC_ALL=C apt-cache depends "$1" | sed -nE 's/^ *Depends: (lib(boost[0-9.]+-dev|simbody[0-9.]+))$/\1/p')
  work=$(mktemp -d)
  (cd "$work" && apt-get -q -o APT::Sandbox::User=root download "$1" "${names[@]}" >&2) || status=1
  mkdir -p .deps
  for deb in "$work"/*.deb; do
    dpkg-deb --fsys-tarfile "$deb" |
      tar -x -C .deps --exclude='./usr/share' "${left_out[@]/#/--exclude=./usr/include/boost/}" || status=1
  done
  rm -r "$work"
  ((status)) || touch ".deps/$1"
  return "$status"
}

setup_unpacked() {
  local package packages
  mapfile -t packages < <(missing "${unpacked[@]}")
  for package in "${packages[@]}"; do
    [[ ! -e .deps/$package ]] || continue
    if ! command -v apt-get >/dev/null || ! update_lists || ! unpack "$package"; then
      install_packages "$package"
    elif [[ $package == libsimbody-dev ]]; then
      # Simbody's libraries bring LAPACK themselves. To name LAPACK, too, would require its own package of headers.
      sed -i -E 's#/[^;"]*/lib(blas|lapack)\.so;##g' .deps/usr/lib/*/cmake/simbody/SimbodyTargets-*.cmake
    fi
  done
}

setup() {
  local verb wanted packages=()
  [[ ${parts:-all} != all ]] || set -- parts "$@"
  for verb in core "$@"; do
    read -ra wanted <<<"${needs[$verb]:-}"
    mapfile -t -O "${#packages[@]}" packages < <(missing "${wanted[@]}")
  done
  install_packages "${packages[@]}"
  setup_unpacked
}

# Installs what the verb itself needs, without the program's needs.
setup_tools() {
  local wanted packages
  read -ra wanted <<<"${needs[$1]}"
  mapfile -t packages < <(missing "${wanted[@]}")
  install_packages "${packages[@]}"
}

# Installs the optional packages of a verb, if possible.
setup_optional() {
  local wanted packages
  read -ra wanted <<<"${optional[$1]}"
  mapfile -t packages < <(missing "${wanted[@]}")
  install_packages "${packages[@]}" || say "going on without ${packages[*]}"
}
