"""run_docs.py: a page that is wrong fails, with its place; every page with something to run is in the list of tests."""

import os
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import run_docs  # noqa: E402

PROGRAM, MODULE = Path(os.environ["URSULA_PROGRAM"]), Path(os.environ["URSULA_MODULE"])
GOOD = """# A page

```console
$ ursula init my.toml --kind UPS
wrote my.toml; …
$ ursula check my.toml
my.toml: the scenario and its motion are valid; 0 warnings
```

```python
import ursula
print(f"{ursula.read_scenario('my.toml').duration + 1e-9:.12f} s, {1.7e-13} N")
```

```text
3.0000 s, 2e-15 N
```
"""


def run(folder, text):
    page = folder / "page.md"
    page.write_text(text)
    return run_docs.run_page(page, PROGRAM, MODULE)


def test_a_good_page_passes(tmp_path):
    assert run(tmp_path, GOOD) == 2


@pytest.mark.parametrize("old, new, words", [
    ("ursula check my.toml", "ursula check mine.toml", r"page\.md:3: exit code 2 of\n +ursula check mine.toml"),
    ("ursula check my.toml", "ursula chekc my.toml", "exit code 2"),
    ("0 warnings", "1 warnings", "expected the line\n +my.toml: the scenario and its motion are valid; 1 warnings"),
    ("wrote my.toml", "written my.toml", "expected the line"),
    ("3.0000 s", "3.0010 s", r"page\.md:10: expected the line"),
    ("2e-15 N", "2e-3 N", "expected the line"),
    ("import ursula\n", "import ursulla\n", "exit code 1"),
    ("```console", "```", "expected a console block"),
    ("```console", "```sh", "belongs into a console block"),
    ("```python", "```cpp", "letter for letter"),
])
def test_a_page_that_is_wrong_fails(tmp_path, old, new, words):
    assert GOOD.count(old) == 1 or new.startswith("```") or old == "import ursula\n"
    with pytest.raises(run_docs.Wrong, match=words):
        run(tmp_path, GOOD.replace(old, new).replace("$ ", "", 2 if new == "```sh" else 0))


@pytest.mark.parametrize("shown, found, same", [
    ("1.234 N", "1.2349 N", True), ("1.234 N", "1.236 N", False), ("15 of 15", "15 of 15", True), ("15 of 15", "14 of 15", False),
    ("3e-14", "9.1e-17", True), ("3e-14", "3e-5", False), ("a … b", "a  c   b", True), ("a b", "a b c", False),
    ("1e-3 m", "1.4e-3 m", True), ("1e-3 m", "3e-3 m", False), ("x = nan", "x = 1", False), ("0.5", "nan", False),
])
def test_numbers_are_compared_to_the_digits_shown(shown, found, same):
    assert run_docs.matches(shown, found) == same


def test_what_is_long_is_left_out_unless_asked_for(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("```console long\n$ exit 3\n```\n" + GOOD)
    assert run_docs.run_page(page, PROGRAM, MODULE) == 2
    with pytest.raises(run_docs.Wrong, match="exit code 3"):
        run_docs.run_page(page, PROGRAM, MODULE, long=True)


def test_every_page_with_something_to_run_is_run():
    listed = re.search(r"foreach\(page ([^)]*)\)", (ROOT / "tests/site/CMakeLists.txt").read_text())[1].split()
    with_blocks = {page.stem for page in (ROOT / "docs").glob("*.md")
                   if any(language in ("console", "python", "cpp") or not language and "ursula " in body
                          for language, body, _ in run_docs.blocks(page.read_text()))}
    assert with_blocks <= set(listed) and len(listed) >= 8
