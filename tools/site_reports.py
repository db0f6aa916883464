"""Reports on wrong efforts, which the program makes while the site is built, as pages and pictures."""

import hashlib
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

SAMPLES = 151
WIDTH, HEIGHT = 1100, 720
LARGEST = 300_000  # bytes of a picture

# name: a change of the right efforts, which are rows of (time, six efforts)
EXAMPLES = {
    "right": lambda rows: rows,
    "swapped": lambda rows: [[t, b, a, *rest] for t, a, b, *rest in rows],
    "no_gravity": None,
    "late": lambda rows: [[t, *rows[max(k - 2, 0)][1:]] for k, (t, *_) in enumerate(rows)],
}


def run(program, *arguments, folder, allowed=(0,)):
    done = subprocess.run([str(program), *map(str, arguments)], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode not in allowed:
        raise OSError(f"ursula {arguments[0]} ended with exit code {done.returncode}, expected one of {allowed}: {done.stderr.strip()}")
    return done.stdout


def efforts(program, scenario, folder):
    lines = run(program, "inverse", scenario, "--samples", SAMPLES, folder=folder).splitlines()
    header = lines[0].split(",")
    columns = [0] + [k for k, name in enumerate(header) if name.startswith("tau_")]
    return [header[k] for k in columns], [[float(line.split(",")[k]) for k in columns] for line in lines[1:]]


def write_rows(path, header, rows):
    path.write_text(",".join(header) + "\n" + "".join(",".join(f"{each:.17g}" for each in row) + "\n" for row in rows), encoding="utf-8")


def screenshot(chromium, page, picture):
    sandbox = ["--no-sandbox"] if os.geteuid() == 0 else []
    with tempfile.TemporaryDirectory() as profile:
        subprocess.run([chromium, "--headless", "--disable-gpu", "--hide-scrollbars", *sandbox, f"--user-data-dir={profile}",
                        f"--window-size={WIDTH},{HEIGHT}", "--virtual-time-budget=8000", f"--screenshot={picture}", page.as_uri()],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=120)
    if not 5000 < picture.stat().st_size < LARGEST:
        raise OSError(f"{picture}: {picture.stat().st_size} bytes, expected a picture of 5,000 to {LARGEST}")


def write(program, chromium, folder, kept):
    """Writes reports into a folder of pages; those that an unchanged program made before come from the folder `kept`."""
    stamp = kept / "made_by"
    made_by = hashlib.sha1(program.read_bytes() + Path(__file__).read_bytes()).hexdigest()
    if not stamp.is_file() or stamp.read_text(encoding="utf-8") != made_by:
        shutil.rmtree(kept, ignore_errors=True)
        make(program, chromium, kept / "pictures", kept / "reports")
        stamp.write_text(made_by, encoding="utf-8")
    shutil.copytree(kept / "pictures", folder / "pictures", dirs_exist_ok=True)
    shutil.copytree(kept / "reports", folder / "extra" / "reports")


def make(program, chromium, pictures, reports):
    pictures.mkdir(parents=True)
    reports.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as temporary:
        work = Path(temporary)
        run(program, "init", "my.toml", "--kind", "UPS", folder=work)
        text = (work / "my.toml").read_text(encoding="utf-8")
        (work / "weightless.toml").write_text(text.replace("-9.81]", "0.0]"), encoding="utf-8")
        header, right = efforts(program, "my.toml", work)
        run(program, "check", "my.toml", "--picture", pictures / "my.svg", folder=work)
        for name, spoil in EXAMPLES.items():
            rows = spoil(right) if spoil else efforts(program, "weightless.toml", work)[1]
            write_rows(work / f"{name}.csv", header, rows)
            run(program, "validate", "my.toml", "--torques", f"{name}.csv", "--out", name, folder=work,
                allowed=(0,) if name == "right" else (1,))
            shutil.copytree(work / name, reports / name)
            screenshot(chromium, work / name / "report.html", pictures / f"{name}.png")
