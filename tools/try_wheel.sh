#!/usr/bin/env bash
# tools/try_wheel.sh FOLDER [--quick] makes a wheel in FOLDER and installs it into an empty virtual environment, where it
# asks for NumPy. With links to the system's NumPy alone it runs an example there, and without --quick, with links to
# pytest too, the module's tests. Nothing is fetched.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=${1:?FOLDER}
export PIP_NO_INDEX=1 PIP_DISABLE_PIP_VERSION_CHECK=1 PYTHONDONTWRITEBYTECODE=1
unset PYTHONPATH

rm -rf "$folder" "$folder-try"
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
assert any("libSimTKsimbody" in name for name in names) and any("libursula" in name for name in names), names
other = [each for each in loaded if not each.startswith(here)
         and not re.search(r"/lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+|z|expat|ffi|ssl|crypto|lzma|bz2|uuid|b2|blas|lapack|gfortran|quadmath)[-.]|/ld-|/python|numpy|lib-dynload", each)]
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
PYTHON
if [[ ${2:-} != --quick ]]; then
  link pytest _pytest pluggy iniconfig packaging attr attrs py py.py more_itertools
  MPLBACKEND=agg URSULA_PROGRAM=$PWD/build/ursula "$python" -m pytest -q -p no:cacheprovider tests/python
fi
echo "try_wheel: $(basename "${wheels[0]}"), $(($(stat -c %s "${wheels[0]}") / 1000000)) MB, works in an empty virtual environment"
