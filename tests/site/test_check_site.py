"""check_site.py: each kind of broken link is found, and nothing in a good site."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
import check_site  # noqa: E402

GOOD = {
    "index.html": '<link rel="stylesheet" href="a.css"><a href="page.html#here">x</a><img src="p.png"><a href="https://example.org">out</a>',
    "page.html": '<h1 id="here">h</h1><a href="#here">x</a><a href="index.html">up</a>',
    "a.css": "p { background: url(p.png) }",
    "p.png": "",
}


def found(folder, **changes):
    for name, text in {**GOOD, **changes}.items():
        (folder / name).write_text(text)
    return list(check_site.findings(folder))


def test_a_good_site_has_no_finding(tmp_path):
    assert found(tmp_path) == [] and check_site.main([str(tmp_path)]) == 0


@pytest.mark.parametrize("old, new, words", [
    ("page.html#here", "page.html#there", "has no anchor 'there'"),
    ('href="page.html#here"', 'href="none.html"', "leads to none.html, which is not there"),
    ('href="page.html#here"', 'href="a.css"', "page.html: no page leads here"),
    ("p.png", "q.png", "leads to q.png, which is not there"),
    ("a.css", "https://example.org/a.css", "fetches https://example.org/a.css from the net"),
    ('src="p.png"', 'src="//example.org/p.png"', "fetches //example.org/p.png from the net"),
    ("page.html#here", "../page.html", "which is not there"),
])
def test_what_is_broken_is_found(tmp_path, old, new, words):
    assert old in GOOD["index.html"]
    assert any(words in each for each in found(tmp_path, **{"index.html": GOOD["index.html"].replace(old, new)}))
    assert check_site.main([str(tmp_path)]) == 1


def test_styles_fetch_nothing(tmp_path):
    assert any("a.css: fetches" in each for each in found(tmp_path, **{"a.css": "@import 'https://example.org/b.css';"}))


def test_a_folder_without_a_site_is_refused(tmp_path, capsys):
    assert check_site.main([str(tmp_path)]) == 1 and "has no index.html" in capsys.readouterr().out
