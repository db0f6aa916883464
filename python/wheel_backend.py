"""Makes a wheel of the Python module for pip (PEP 517). CMake builds it, and the wheel contains the libraries that it needs.

Debian 12 has no backend for CMake. This one asks pip for nothing, so `pip install .` works without a network. It
builds in build/, the folder of ./dev build; for another Python than the system's it uses a folder below.

The metadata need no build. CMake configures before pip asks for them, so that a missing package ends pip at once, in a
line. `pip -v` shows the build's progress.
"""

import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SUFFIX = sysconfig.get_config_var("EXT_SUFFIX")
# NumPy may have loaded the system's; a library of the same name would then not be loaded.
RENAMED = {name: name.replace(".so", "-ursula.so") for name in ("liblapack.so.3", "libblas.so.3")}
# Every system has the C library and the compiler's own.
OF_THE_SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+))\.so")


SETUP = "run ./dev setup wheel first"


def run(*command, **options):
    """Returns the command's output; ends the program with its own message if it fails."""
    if not shutil.which(command[0]):
        sys.exit(f"ursula: no {command[0]} here: {SETUP}")
    done = subprocess.run([*map(str, command)], text=True, **{"stdout": subprocess.PIPE, **options})
    if done.returncode != 0:
        sys.exit(done.stderr or f"ursula: {command[0]} failed; `pip -v` shows what it said")
    return done.stdout


def version():
    return re.search(r"project\(ursula VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def metadata():
    return (f"Metadata-Version: 2.1\nName: ursula\nVersion: {version()}\n"
            "Summary: whether the dynamics of a six-dof parallel manipulator is right, and why\n"
            "License: Apache-2.0\nRequires-Python: >=3.9\nRequires-Dist: numpy\n"
            "Description-Content-Type: text/markdown\n\n" + (ROOT / "README.md").read_text())


def tag():
    """Returns the wheel's tag: this Python, and this C library or a newer one."""
    python = "cp{}{}".format(*sys.version_info)
    libc = os.confstr("CS_GNU_LIBC_VERSION").split()[1].replace(".", "_")
    return f"{python}-{python}-manylinux_{libc}_{os.uname().machine}"


def configured():
    """Returns the build's folder for this Python, once CMake has found all that the module needs."""
    for program in ("cmake", "ninja", "strip", "patchelf"):
        run(program, "--version")
    systems = Path("/usr/bin/python3")
    same = systems.exists() and SUFFIX == run(systems, "-c", "import sysconfig as s; print(s.get_config_var('EXT_SUFFIX'))").strip()
    folder = ROOT / "build" if same else ROOT / "build" / SUFFIX.strip(".")
    ninja = folder / "build.ninja"
    if has_module(ninja):
        return folder
    # A folder that was configured without pybind11 keeps its settings.
    how = [folder] if ninja.exists() else ["--preset", "release", "-B", folder, "-DURSULA_TESTS=OFF", "-DURSULA_BENCH=OFF"]
    how.append("-DURSULA_PARTS=all")
    of_python = [] if same else [f"-DPython_EXECUTABLE={sys.executable}"]
    tried = subprocess.run(["cmake", *map(str, how), *of_python], cwd=ROOT, text=True, capture_output=True)
    if tried.returncode != 0:
        why = re.search(r"CMake Error[^\n]*\n+((?: +\S[^\n]*\n)+)", tried.stderr)
        sys.exit(f"ursula: {' '.join(why[1].split()) if why else 'CMake cannot configure the build'}: {SETUP}")
    print(tried.stdout)
    if not has_module(ninja):
        sys.exit(f"ursula: no pybind11 here, or no headers of Python: {SETUP}")
    return folder


def has_module(ninja):
    return ninja.exists() and "build ursula_python:" in ninja.read_text()


def built():
    """Builds the module for this Python with CMake, and returns its folder."""
    folder = configured()
    run("cmake", "--build", folder, "--target", "ursula_python", stdout=None)
    return folder / "python" / "ursula"


def needed(library):
    """Returns the shared libraries that this one loads, as paths by name, without the system's own."""
    lines = run("ldd", library).splitlines()
    missing = [line.strip() for line in lines if "not found" in line]
    if missing:
        sys.exit(f"ursula: {library}: {', '.join(missing)}")
    found = re.findall(r"^\s*(\S+) => (/\S+)", "\n".join(lines), re.MULTILINE)
    return {name: path for name, path in found if not OF_THE_SYSTEM.match(name)}


def laid_out(work):
    """Makes the installed package in `work`. Libraries are in ursula/lib; run paths relative to each file find them."""
    package = work / "ursula"
    shutil.copytree(built(), package, ignore=shutil.ignore_patterns("__pycache__"))
    module = package / f"_ursula{SUFFIX}"
    (package / "lib").mkdir()
    for name, path in needed(module).items():
        shutil.copy(path, package / "lib" / RENAMED.get(name, name))
    for file in (module, *(package / "lib").iterdir()):
        os.chmod(file, 0o755)
        run("strip", "--strip-unneeded", file)
        changes = [["--replace-needed", *pair] for pair in RENAMED.items()]
        changes += [["--set-soname", file.name]] if file.name in RENAMED.values() else []
        for change in [*changes, ["--set-rpath", "$ORIGIN/lib" if file == module else "$ORIGIN"]]:
            run("patchelf", *change, file)  # one by one, as patchelf 0.14 confuses several
    return described(work)


def described(folder):
    """Makes the wheel's metadata in `folder`, and returns their own."""
    info = Path(folder) / f"ursula-{version()}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(metadata())
    (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: ursula\nRoot-Is-Purelib: false\nTag: {tag()}\n")
    shutil.copy(ROOT / "LICENSE", info)
    return info


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    configured()
    return described(metadata_directory).name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"ursula-{version()}-{tag()}.whl"
    work = Path(wheel_directory) / (name + ".parts")
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    try:
        info = laid_out(work)
        record = [f"{info.name}/RECORD,,"]
        with zipfile.ZipFile(work / name, "w", zipfile.ZIP_DEFLATED) as wheel:
            for file in sorted(each for part in (work / "ursula", info) for each in part.rglob("*") if each.is_file()):
                digest = base64.urlsafe_b64encode(hashlib.sha256(file.read_bytes()).digest()).decode().rstrip("=")
                record.append(f"{file.relative_to(work)},sha256={digest},{file.stat().st_size}")
                wheel.write(file, file.relative_to(work))
            wheel.writestr(f"{info.name}/RECORD", "\n".join(record) + "\n")
        os.replace(work / name, Path(wheel_directory) / name)
    finally:
        shutil.rmtree(work)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """Packs the tracked files, for `python3 -m build`."""
    base = f"ursula-{version()}"
    with tarfile.open(Path(sdist_directory) / f"{base}.tar.gz", "w:gz") as out:
        for file in run("git", "ls-files", cwd=ROOT).splitlines():
            out.add(ROOT / file, f"{base}/{file}")
        info = Path(sdist_directory) / "PKG-INFO"
        info.write_text(metadata())
        out.add(info, f"{base}/PKG-INFO")
        info.unlink()
    return f"{base}.tar.gz"
