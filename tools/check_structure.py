#!/usr/bin/env python3
"""Checks the tree against the promises of documents and design.

    tools/check_structure.py [ROOT]          who includes whom; docs/equations.md against the tags in the code; paths
                                             that documents and comments name
    tools/check_structure.py --tags [ROOT]   only lists which file carries the tag of which equation

Exits with 0, or with 1 after one line `place: what is wrong` for each finding.
"""

import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
import components  # noqa: E402
import named_paths  # noqa: E402
import sources  # noqa: E402

# The folders that each folder may include from, beside itself. The order is from the ground up, so every arrow points down, and none
# leads from the core into parts/.
CORE = "base model nocsolver simbody validation report apps"
ALLOWED = {
    "base": "",
    "model": "base",
    "nocsolver": "base model",
    "simbody": "base model",
    "validation": "base model nocsolver simbody",
    "report": "base model nocsolver validation",
    "apps": "base model nocsolver validation report",
    "parts": CORE,
    "include": f"{CORE} parts",
    "examples": "",
    "python": "",
    "tests": f"bench examples {CORE.replace(' apps', '')} parts apps",
    "bench": f"{CORE} parts",
}
ENGINE_HEADER = re.compile(r"(?i)^(simbody|simtk|simmath|mujoco/|dart/)|/(simbody|simtk|simmath)")
# Users of the library have the standard library, Eigen and the library itself.
PYTHONS_HEADER = re.compile(r"pybind11/[\w/]+\.h")
ENGINES_HEADER = re.compile(r"(mujoco|dart|drake|pinocchio|rbdl)/|tinyxml2\.h$")
USERS_HEADER = re.compile(r"[a-z_]+|Eigen/\w+|ursula/\w+\.h")
# Within nocsolver/ the legs never see the dynamics.
WITHIN_SOLVER = {"legs": {"legs"}, "noc": {"noc", "legs"}, "loops": {"loops", "noc"}, "": {"noc", "legs", ""}}
NAMESPACE = re.compile(r"namespace ([\w:]+) \{")
TYPE = re.compile(r"(?:struct|class|enum class|enum) (\w+)(?: final)?(?: : [^;{]*)? ?\{")
# An engine's own folder; side_by_side/ compares them.
ENGINE_FOLDER = re.compile(r"^(simbody|parts/engines/(?!side_by_side)\w+)/")
FAST = re.compile(r"^parts/fast/(?!fast_(samples|checks|subject)\b)")

MAP = "docs/equations.md"
TAGGED_FOLDERS = ("base", "model", "nocsolver", "simbody", "validation", "report", "parts")
LAST_EQUATION = 55
PARTS = {2: "ab", 4: "abc", 11: "ab", 14: "ab", 15: "ab", 17: "ab", 19: "ab", 20: "ab", 30: "ab", 32: "ab",
         39: "abc", 41: "abc", 42: "ab", 43: "abc", 46: "abc", 51: "abcd"}
EQUATIONS = [f"{n}{part}" for n in range(1, LAST_EQUATION + 1) for part in PARTS.get(n, [""])]


# --- who includes whom ------------------------------------------------------------------------------------------------

def check_includes(root):
    findings = []
    for path in sources.files(root):
        text = sources.read(root, path)
        folder = path.split("/")[0]
        for line, name, quoted in sources.includes(text):
            place = f"{path}:{line}"
            if folder in ("tests", "bench") and quoted:
                name = sources.resolve(root, path, name)
            if quoted and not (root / name).is_file():
                findings.append(f'{place}: "{name}" is no file of this project: name it from the root, or in <> if it is another\'s')
            top = name.split("/")[0]
            if top in sources.FOLDERS and top != folder and top not in ALLOWED[folder].split():
                findings.append(f"{place}: {folder}/ may not include {top}/ ({name})")
            if folder == top == "nocsolver" and name != "nocsolver/errors.h":
                here, there = (part.split("/")[1] if part.count("/") > 1 else "" for part in (path, name))
                if there not in WITHIN_SOLVER.get(here, set()):
                    findings.append(f"{place}: nocsolver/{here} may not include nocsolver/{there} ({name})")
            if sources.is_internal(name) and sources.is_header(path) and not sources.is_internal(path):
                findings.append(f"{place}: a header that others include may not include {name}, which is internal")
        findings += check_engines(root, path)
        if folder in ("include", "examples", "python"):
            findings += check_users(root, path)
        if sources.is_header(path) and not sources.is_internal(path):
            findings += check_no_simtk(path, text)
    return findings


def check_engines(root, path):
    """Engines and the solver never see each other, not even through a third file."""
    findings = []
    for name, chain in sources.reach(root, path).items():
        via = " -> ".join(chain)
        if path.startswith("nocsolver/") and (ENGINE_HEADER.search(name) or ENGINE_FOLDER.match(name)):
            findings.append(f"{path}: the solver may not see an engine ({via})")
        if path.startswith("nocsolver/") and name.startswith("model/legs/"):
            findings.append(f"{path}: the solver may not see the engines' geometry ({via})")
        if ENGINE_FOLDER.match(path) and name.startswith("nocsolver/"):
            findings.append(f"{path}: an engine may not see the solver ({via})")
        if FAST.match(path) and name.startswith("nocsolver/noc/") and not path.endswith("fast/solver.h"):
            findings.append(f"{path}: the kernels may not see the NOC, which is compared with them ({via})")
        if (path.startswith("parts/engines/") and ENGINE_FOLDER.match(path) and ENGINE_FOLDER.match(name)
                and ENGINE_FOLDER.match(path)[1] not in (ENGINE_FOLDER.match(name)[1], "parts/engines/simbody")):
            findings.append(f"{path}: an engine may not see another ({via})")
    return findings


def check_users(root, path):
    """A public header, with all that it includes, and an example need nothing that users do not have."""
    return [f"{path}: users of the library do not have {name} ({' -> '.join(chain)})"
            for name, chain in sources.reach(root, path).items()
            if not (root / name).is_file() and not USERS_HEADER.fullmatch(name)
            and not (path.startswith("python/") and PYTHONS_HEADER.fullmatch(name))
            and not (path.startswith("examples/engines/") and ENGINES_HEADER.match(name))]


def check_no_simtk(path, text):
    code = sources.code_only(text)
    return [f"{path}:{number}: SimTK in a header that others include (only *_internal headers may)"
            for number, line in enumerate(code.splitlines(), 1) if "SimTK" in line] + [
            f"{path}:{line}: {name} in a header that others include (only *_internal headers may)"
            for line, name, quoted in sources.includes(text) if not quoted and ENGINE_HEADER.search(name)]


def check_type_names(root):
    """Two types of one name in one namespace would be one type to the linker."""
    findings, places = [], {}
    for path in sources.files(root, (*CORE.split(), "parts")):
        if not sources.is_header(path):
            continue
        namespace = ""
        for number, line in enumerate(sources.code_only(sources.read(root, path)).splitlines(), 1):
            opened, named = NAMESPACE.match(line), TYPE.match(line)
            namespace = opened[1] if opened else namespace
            if named and places.setdefault((namespace, named[1]), path) != path:
                findings.append(f"{path}:{number}: {namespace}::{named[1]} is in {places[namespace, named[1]]}, too")
    return findings


def check_headers(root):
    """A lower optimisation has no effect beside the hot precompiled header, so only ursula_use_cold() sets it."""
    return [f"{path.relative_to(root)}:{number}: -O{level} has no effect beside the hot header: use ursula_use_cold()"
            for folder in (*CORE.split(), "parts") for path in sorted((root / folder).rglob("CMakeLists.txt"))
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
            for level in re.findall(r"(?<![\w-])-O([0-2s])\b", line.split("#")[0])]


def check_targets(root):
    """Checks what the CMake targets of each folder link."""
    forbidden = {"base": re.compile(r"(?i)ursula::(?!options|eigen|base)\w+|simbody|mujoco"),
                 "model": re.compile(r"(?i)ursula::(nocsolver|validation|report)|simbody|mujoco"),
                 "nocsolver": re.compile(r"(?i)simbody|mujoco|ursula::(?!model|nocsolver|loops)\w+|tbb"),
                 "simbody": re.compile(r"(?i)mujoco|ursula::(?!model|simbody|lapack)\w+"),
                 "validation": re.compile(r"(?i)ursula::(apps|report)|\$\{(simbody|ursula_mujoco)_"),
                 "report": re.compile(r"(?i)ursula::apps|\$\{(simbody|ursula_mujoco)_"),
                 "parts": re.compile(r"(?i)\$\{(simbody|ursula_mujoco)_"),
                 "parts/exchange": re.compile(r"(?i)ursula::(?!base|model|exchange)\w+|simbody|mujoco")}
    findings = []
    for folder, pattern in forbidden.items():
        path = root / folder / "CMakeLists.txt"
        if not path.is_file():
            findings.append(f"{folder}/CMakeLists.txt: missing")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            found = pattern.search(line.split("#")[0])
            if found:
                findings.append(f"{folder}/CMakeLists.txt:{number}: {folder} may not link {found.group()}")
    return findings


# --- the equation map -------------------------------------------------------------------------------------------------

def parse_equations(words):
    """'15a' -> [15a]; '15' -> [15a, 15b]; '4a–c' -> [4a, 4b, 4c]; '22–24' -> [22, 23, 24]; a list with ', ' or ' and '.
    None if it cannot be read or names an equation that the paper does not have."""
    result = []
    for item in re.split(r", and |, | and ", words):
        match = re.fullmatch(r"\(?(\d+)([a-d]?)\)?(?:[–-]\(?(\d*)([a-d]?)\)?)?", item)
        if not match:
            return None
        first, last = int(match[1]), int(match[3] or match[1])
        from_part, to_part = match[2], match[4] or (match[2] if match[3] is None else "")
        if match[3] == "" and not (match[2] and match[4]):
            return None
        found = [e for e in EQUATIONS if _in_range(e, first, from_part, last, to_part)]
        if not found or f"{first}{from_part}" not in EQUATIONS and (from_part or first not in PARTS):
            return None
        result += found
    return result


def _in_range(equation, first, from_part, last, to_part):
    number, part = int(equation.rstrip("abcd")), equation.lstrip("0123456789")
    after = number > first or number == first and (not from_part or part >= from_part)
    before = number < last or number == last and (not to_part or part <= to_part)
    return after and before


def tags_in_code(root):
    """({equation: {file: line}}, findings)"""
    tags, findings = {}, []
    for path in sources.files(root, TAGGED_FOLDERS):
        for number, line in enumerate(sources.read(root, path).splitlines(), 1):
            for match in re.finditer(r"\(paper,?\s*(eqs?\b[^)]*|$)(\)[^()]*\))?\)?", line):
                exact = re.match(r"\(paper, eqs?\. ((?:\([^()]*\)|[^()])+)\)", line[match.start():])
                equations = parse_equations(exact[1]) if exact else None
                if equations is None:
                    findings.append(f"{path}:{number}: cannot read the tag {line[match.start():].strip()[:50]!r}: "
                                    "write (paper, eq. 15a) or (paper, eqs. 4a–c, 13), on one line")
                    continue
                for equation in equations:
                    tags.setdefault(equation, {}).setdefault(path, number)
    return tags, findings


def read_map(root):
    """({equation: (line, code cell, test cell)}, findings)"""
    rows, findings = {}, []
    if not (root / MAP).is_file():
        return rows, [f"{MAP}: missing"]
    for number, line in enumerate(sources.read(root, MAP).splitlines(), 1):
        if not re.match(r"\|\s*\(\d", line):
            continue
        cells = [c.strip() for c in re.split(r"(?<!\\)\|", line.strip())[1:-1]]
        equation = cells[0].strip("()")
        if len(cells) != 5 or cells[0] != f"({equation})" or not all(cells):
            findings.append(f"{MAP}:{number}: five filled cells expected: | (15a) | what | code | test | deviation |")
        elif equation not in EQUATIONS:
            findings.append(f"{MAP}:{number}: the paper has no equation ({equation})")
        elif equation in rows:
            findings.append(f"{MAP}:{number}: ({equation}) has a row already, line {rows[equation][0]}")
        else:
            rows[equation] = (number, cells[2], cells[3])
    findings += [f"{MAP}: no row for ({e})" for e in EQUATIONS if e not in rows]
    return rows, findings


def read_cell(root, place, cell, kind):
    """({file}, findings) of a code or test cell: `path`: name, name; `path`: name. Or an em dash and why there is none."""
    if cell.startswith("—"):
        return set(), [] if len(cell) > 3 else [f"{place}: neither {kind} nor a reason: fill in, or write '— why not'"]
    found, findings = set(), []
    for entry in re.split(r"\s*;\s*|\s*<br>\s*", cell):
        match = re.fullmatch(r"`([\w./-]+/[\w.-]+\.\w+)`(?::\s*(.+))?", entry)
        if not match:
            findings.append(f"{place}: cannot read {kind} {entry!r}: write `path/file`: name, name; `path/file`: name")
            continue
        path, names = match[1], match[2]
        if not (root / path).is_file():
            findings.append(f"{place}: there is no {path}")
            continue
        found.add(path)
        if not names:
            findings.append(f"{place}: name what in {path} it is")
            continue
        text = sources.read(root, path)
        for name in re.split(r"\s*,\s*", names.replace("`", "")):
            if not all(re.search(rf"\b{re.escape(part)}\b", text) for part in re.split(r"\.|::", name)):
                findings.append(f"{place}: {path} does not have {name}")
    return found, findings


def check_equations(root):
    tags, findings = tags_in_code(root)
    rows, more = read_map(root)
    findings += more
    for equation, (number, code, test) in rows.items():
        place = f"{MAP}:{number}: ({equation})"
        mapped, more = read_cell(root, place, code, "code")
        _, tests = read_cell(root, place, test, "test")
        findings += more + tests
        tagged = tags.get(equation, {})
        findings += [f"{path}:{line}: tagged with ({equation}), but that row of {MAP} does not name this file"
                     for path, line in tagged.items() if path not in mapped]
        findings += [f"{place} names {path}, which carries no tag (paper, eq. {equation})"
                     for path in sorted(mapped - set(tagged))]
    return findings


def main(arguments):
    only_tags = "--tags" in arguments
    places = [a for a in arguments if a != "--tags"]
    root = Path(places[0] if places else Path(__file__).resolve().parent.parent)
    if only_tags:
        tags, findings = tags_in_code(root)
        for equation in EQUATIONS:
            print(f"({equation})", ", ".join(f"{p}:{n}" for p, n in tags.get(equation, {}).items()) or "—")
    else:
        findings = (check_includes(root) + check_type_names(root) + check_targets(root) + check_headers(root) + components.check_components(root) + check_equations(root)
                    + named_paths.check_paths(root) + named_paths.check_subfolders(root))
    print(*findings, sep="\n", end="\n" if findings else "", file=sys.stderr)
    if not findings and not only_tags:
        print(f"structure: {len(sources.files(root))} files, {len(components.VALIDATION)} components, {len(components.parts(root))} parts, {len(EQUATIONS)} equations, nothing amiss")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
