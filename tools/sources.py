"""The source tree for the checks: files, their includes, and their text without comments."""

import posixpath
import re
from pathlib import Path

FOLDERS = ("base", "model", "nocsolver", "simbody", "validation", "report", "apps", "parts", "include", "examples", "python", "tests",
           "bench")
SUFFIXES = (".h", ".hpp", ".inl", ".cpp")
HEADER_SUFFIXES = (".h", ".hpp", ".inl")

_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.M)
_COMMENT_OR_STRING = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<tag>[^()\\\s]{0,16})\(.*?\)(?P=tag)"|"(?:\\.|[^"\\\n])*"', re.S)


def files(root, folders=FOLDERS):
    """Paths relative to root, with forward slashes, sorted."""
    found = []
    for folder in folders:
        found += [p.relative_to(root).as_posix() for p in (root / folder).rglob("*")
                  if p.suffix in SUFFIXES and "node_modules" not in p.parts]
    return sorted(found)


def read(root, path):
    return (Path(root) / path).read_text(encoding="utf-8")


def is_header(path):
    return path.endswith(HEADER_SUFFIXES)


def is_internal(path):
    return Path(path).stem.endswith("_internal")


def includes(text):
    """[(line, name, quoted)] of every include directive."""
    return [(text.count("\n", 0, m.start(2)) + 1, m.group(2), m.group(1) == '"') for m in _INCLUDE.finditer(text)]


def resolve(root, path, name):
    """The file of ours that `path` means by `name`: named from the root, or beside `path`. Returns `name` if it is no file of ours."""
    beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
    return beside if not (Path(root) / name).is_file() and (Path(root) / beside).is_file() else name


def code_only(text):
    """The text with comments and string literals blanked; line numbers stay."""
    return _COMMENT_OR_STRING.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)


def reach(root, path):
    """{file or <header>: chain of files leading to it} over everything that `path` includes, directly or not."""
    chains, pending = {}, [(path, (path,))]
    while pending:
        current, chain = pending.pop()
        if not (Path(root) / current).is_file():
            continue
        for _, name, quoted in includes(read(root, current)):
            name = resolve(root, current, name) if quoted else name
            if name not in chains:
                chains[name] = chain + (name,)
                pending.append((name, chain + (name,)))
    return chains
