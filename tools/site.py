#!/usr/bin/env python3
"""Builds the documentation site from docs/: site.py OUT --program build/ursula.

It copies docs/ to a folder beside OUT and adds generated pages: the references of the libraries, drawings of the legs, reports
on wrong efforts. Sphinx makes the pages, with warnings as errors. Then every link of the result is followed.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
import check_site  # noqa: E402
import site_api  # noqa: E402
import site_legs  # noqa: E402
import site_reports  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
OUTSIDE = re.compile(r"(!?)\[([^\]]*)\]\(\.\./([^)#]+)(?:#[^)]*)?\)")
OPTIONAL = re.compile(r"^(\w+)  # where it is there\n", re.M)


def with_files(text, extra):
    """Links to files outside docs/ lead to copies in the site; of a link to a folder only the text stays."""
    def copied(match):
        picture, words, path = match.groups()
        source = ROOT / path
        if not source.exists():
            raise FileNotFoundError(f"docs link to ../{path}, which is not there")
        if source.is_dir():
            return words
        readable = source.suffix in (".png", ".svg", ".html", ".json")
        name = f"files/{path}" if readable else f"files/{path}.txt"
        (extra / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, extra / name)
        return f'<img src="{name}" alt="{words}">' if picture else f'<a href="{name}">{words}</a>'

    return OUTSIDE.sub(copied, text)


def stage(folder):
    shutil.rmtree(folder, ignore_errors=True)
    extra = folder / "extra"
    extra.mkdir(parents=True)
    pages = {path.name: path.read_text(encoding="utf-8") for path in (ROOT / "docs").glob("*.md")}
    pages.pop("README.md", None)
    for name, text in pages.items():
        text = OPTIONAL.sub(lambda match: f"{match[1]}\n" if f"{match[1]}.md" in pages else "", text)
        (folder / name).write_text(with_files(text, extra), encoding="utf-8")
    for name in ("conf.py", "scenario.schema.json"):
        shutil.copyfile(ROOT / "docs" / name, folder / name)
    shutil.copyfile(ROOT / "docs/scenario.schema.json", extra / "scenario.schema.json")
    shutil.copytree(ROOT / "docs/_static", folder / "_static")
    return folder


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--chromium", default="chromium")
    given = parser.parse_args()
    out = given.out.resolve()
    source = stage(out.with_name(out.name + "_source"))
    site_api.write(ROOT, source)
    site_legs.write(source)
    site_reports.write(given.program.resolve(), given.chromium, source, out.with_name(out.name + "_reports"))
    shutil.rmtree(out, ignore_errors=True)
    subprocess.run([sys.executable, "-m", "sphinx", "-W", "--keep-going", "-n", "-q", "-j", "auto", "-b", "html", "-d",
                    str(out.with_name(out.name + "_doctrees")), str(source), str(out)],
                   check=True, env={**os.environ, "URSULA_ROOT": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"})
    return check_site.main([str(out)])


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"site: {error}")
