#!/usr/bin/env bash
# tools/try_wheel.sh FOLDER [--quick] makes a wheel in FOLDER and installs it into an empty virtual environment, where it
# asks for NumPy. With links to the system's NumPy alone it runs an example there, and without --quick, with links to
# pytest too, the module's tests. Nothing is fetched. Before that it asks for the metadata alone in a copy of the tree:
# without what the wheel needs, after a build without the module, and with all.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=${1:?FOLDER}
export PIP_NO_INDEX=1 PIP_DISABLE_PIP_VERSION_CHECK=1 PYTHONDONTWRITEBYTECODE=1
unset PYTHONPATH

rm -rf "$folder" "$folder-try" "$folder-copy"
/usr/bin/python3 -m venv "$folder-try"
python=$folder-try/bin/python
packages=$("$python" -c 'import sysconfig; print(sysconfig.get_paths()["purelib"])')
link() {
  local each from
  for each in "$@"; do
    from=/usr/lib/python3/dist-packages/$each
    [[ ! -e $from ]] || ln -s "$from" "$packages/"
  done
}

# What hides a package from CMake stands for its absence.
copy=$folder-copy
mkdir -p "$copy"
git ls-files -z --cached --others --exclude-standard | xargs -0 tar -c | tar -x -C "$copy"
[[ ! -e .deps ]] || ln -s "$PWD/.deps" "$copy/"
# shellcheck disable=SC2016  # the dollar is CMake's
echo 'set(CMAKE_DISABLE_FIND_PACKAGE_$ENV{URSULA_HIDDEN} ON)' >"$copy/hidden.cmake"
ask() { CMAKE_TOOLCHAIN_FILE=$(realpath "$copy/hidden.cmake") URSULA_HIDDEN=$1 "$python" -m pip install --dry-run --no-deps "$copy" 2>&1; }
refuses_without() {
  if said=$(ask "$1"); then echo "without $1: $said" >&2; return 1; fi
  if [[ $said != *"run ./dev setup wheel first"* || $said == *Traceback* ]]; then echo "without $1: $said" >&2; return 1; fi
}
refuses_without Boost
CMAKE_TOOLCHAIN_FILE=$(realpath "$copy/hidden.cmake") URSULA_HIDDEN=pybind11 \
  cmake -S "$copy" -B "$copy/build" -G Ninja -DURSULA_TESTS=OFF -DURSULA_BENCH=OFF >/dev/null  # as ./dev build does
refuses_without pybind11
said=$(ask Nothing) || { echo "with all: $said" >&2; exit 1; }
grep -q 'Would install ursula' <<<"$said"
if [[ -e $copy/build/libursula.so ]]; then echo 'the metadata need no build' >&2; exit 1; fi

"$python" -m pip wheel -q --no-deps -w "$folder" .
wheels=("$folder"/ursula-*.whl)
"$python" -m pip install -q --no-deps "${wheels[0]}"
said=$("$python" -c 'import ursula' 2>&1 || true)
grep -q '^ImportError: ursula needs NumPy' <<<"$said" || { echo "without NumPy: $said" >&2; exit 1; }
link numpy

# Libraries may come only from the wheel, the interpreter, NumPy and what every system has.
cd "$folder-try"
bin/python - "$PWD" <<'PYTHON'
import re, sys
import ursula
here, loaded = sys.argv[1], sorted({line.split()[-1] for line in open("/proc/self/maps") if ".so" in line})
assert ursula.__file__.startswith(here), ursula.__file__
ours = [each for each in loaded if each.startswith(here)]
names = {re.split(r"[-.]so|-", each.rsplit("/", 1)[-1])[0] for each in ours}
assert {"libSimTKsimbody", "libursula", "liblapack", "libblas"} <= names and "libopenblas" not in str(ours), ours
other = [each for each in loaded if not each.startswith(here)
         and not re.search(r"/lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+|z|expat|ffi|ssl|crypto|lzma|bz2|uuid|b2|blas|lapack|openblas\w*|gfortran|quadmath)[-.]|/ld-|/python|numpy|lib-dynload", each)]
assert not other, other
print(f"the wheel brings {len(ours)} libraries, and loads none of elsewhere but NumPy's and the system's")
PYTHON
cd - >/dev/null

# A NumPy solver of a telescopic hexapod must pass, and fail with an error of a part in a thousand.
"$python" - <<'PYTHON'
import sys
sys.path.append("examples/python")
import ups_solver, ursula
file = "apps/starting/UPS.toml"
s, machine = ursula.read_scenario(file), ups_solver.Machine(file)
for factor, verdict in ((1, "pass"), (1.001, "fail")):
    r = ursula.validate(s, solver=lambda m: factor * ups_solver.forces(machine, m.p, m.q, m.v, m.w, m.a, m.alpha))
    print(f"{factor}: {r.verdict}", r.cause or "")
    assert r.verdict == verdict
    assert "liblapack-ursula.so" in r.summary["provenance"]["LAPACK"], "NumPy's or the system's is called"
PYTHON
if [[ ${2:-} != --quick ]]; then
  link pytest _pytest pluggy iniconfig packaging attr attrs py py.py more_itertools
  MPLBACKEND=agg URSULA_PROGRAM=$PWD/build/ursula "$python" -m pytest -q -p no:cacheprovider tests/python
fi
echo "try_wheel: $(basename "${wheels[0]}"), $(($(stat -c %s "${wheels[0]}") / 1000000)) MB, works in an empty virtual environment"
