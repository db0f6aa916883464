"""The files that READMEs, CONTRIBUTING.md, docs/ and comments name exist, and a top-level folder's README names each of its subfolders."""

import fnmatch
import os
import re

import sources

FOLDERS = (*sources.FOLDERS, "cmake", "docs", "results", "scenarios", "sweeps", "tools")
SOURCES = (*sources.SUFFIXES, ".py", ".cmake")
# A path of this tree begins with one of its folders or ends like a source file. Users write folders in a results/ of their own.
PATH = re.compile(r"[\w*.-]+(?:/[\w*.-]+)*/?")
OURS = re.compile(rf"(?:{'|'.join(f for f in FOLDERS if f != 'results')})/|[\w*./-]+\.(?:h|inl|cpp|py|cmake|mjs|md)$")
OTHERS = {"mujoco/mujoco.h", "mujoco.h", "Simbody.h", "mine.py", "path/file.h", "path/other.cpp"}  # of libraries, of users, of nobody
_COMMENT = {".py": re.compile(r'#[^\n]*|""".*?"""', re.S), ".cmake": re.compile(r"#[^\n]*")}
_CPP_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.S)


def tree(root):
    """Paths of files and, with a slash at their end, of folders."""
    found = {p.name for p in root.iterdir() if p.is_file()} | {f"{folder}/" for folder in FOLDERS if (root / folder).is_dir()}
    for folder in FOLDERS:
        for place, folders, files in os.walk(root / folder):
            folders[:] = [f for f in folders if f not in ("node_modules", "__pycache__")]
            inside = os.path.relpath(place, root)
            found |= {f"{inside}/{f}/" for f in folders} | {f"{inside}/{f}" for f in files}
    return found


def comments(path, text):
    """[(line, comment)]"""
    suffix = ".cmake" if path.endswith("CMakeLists.txt") else path[path.rfind("."):]
    pattern = _COMMENT.get(suffix, _CPP_COMMENT)
    return [(text.count("\n", 0, m.start()) + 1, m.group()) for m in pattern.finditer(text)]


def quoted(text):
    """[(line, what stands in backticks)]"""
    return [(text.count("\n", 0, m.start()) + 1, m.group(1)) for m in re.finditer(r"(?<!`)`([^`\n]+)`(?!`)", text)]


def named(words):
    """The paths of this tree that the words name; NAME and KIND stand for any word."""
    for word in words.split():
        word = word.strip(".,:;()[]'\"`")
        if PATH.fullmatch(word) and OURS.match(word) and word not in OTHERS:
            yield re.sub(r"\b[A-Z]{2,}(?=\b|_)", "*", word)


def check_paths(root):
    there = tree(root)
    names = there | {path.rstrip("/") for path in there}
    ends = {end for path in names for end in (path.split("/", k)[-1] for k in range(path.count("/") + 1))}
    findings = []
    for path in sorted(there):
        folder = path.split("/")[0]
        if path.endswith(".md") and (path.endswith("README.md") or folder in ("docs", "CONTRIBUTING.md")):
            places = quoted(sources.read(root, path))
        elif path.endswith(SOURCES) or path.endswith("CMakeLists.txt"):
            places = comments(path, sources.read(root, path))
        else:
            continue
        findings += [f"{path}:{line}: there is no {name}" for line, words in places for name in named(words)
                     if name not in ends and name.rstrip("/") not in ends and not fnmatch.filter(ends, name)]
    return findings


def check_subfolders(root):
    there = tree(root)
    findings = []
    for folder in FOLDERS:
        if f"{folder}/README.md" not in there:
            continue
        text = sources.read(root, f"{folder}/README.md")
        inner = sorted(p.split("/")[1] for p in there if p.startswith(f"{folder}/") and p.endswith("/") and p.count("/") == 2)
        findings += [f"{folder}/README.md: does not name {name}/" for name in inner if not re.search(rf"(?<![\w-]){re.escape(name)}/", text)]
    return findings
