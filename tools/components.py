"""The plan of validation/ and parts/: which components of the verdict may see which, and which part may see which. Includes and CMake
targets are checked against it. check_structure.py has the plan of the top-level folders."""

import re

import sources

# A component may see those named, which stand above it in this list; so there is no circle and no arrow back up.
VALIDATION = {
    "verdict": "",
    "subject": "",
    "limits": "verdict subject",
    "samples": "verdict subject limits",
    "replay": "verdict subject limits samples",
    "evidence": "subject limits samples replay",
    "checks": "verdict subject limits samples replay evidence",
    "findings": "verdict subject limits samples replay",
    "check_scenario": "subject",
    "mechanism": "verdict subject evidence checks findings",
    "": "verdict subject limits samples evidence checks findings",  # the entry: validation/*.cpp
    "outside": "verdict subject evidence checks findings mechanism",
}
REPORT_SEES = {"verdict", "subject", "findings"}  # of validation/
ROW = re.compile(r"^ursula_part\((\w+)([^)]*)\)", re.M)
WORDS = {"FIRST", "SEES", "VERBS", "ADDS"}
LARGEST_SHARE = 0.25  # of a folder's lines, in one component


def parts(root):
    """{part: the parts that it may see}, from the rows of parts/CMakeLists.txt, in their order."""
    path = root / "parts/CMakeLists.txt"
    plan = {}
    for name, row in ROW.findall(path.read_text(encoding="utf-8") if path.is_file() else ""):
        words, seen, listing = row.split(), [], False
        for word in words:
            listing = word == "SEES" if word in WORDS else listing
            seen += [word] if listing and word not in WORDS else []
        plan[name] = " ".join(seen)
    return plan


def component_of(path):
    """The component of a path in validation/ or parts/; "" for the entry, None elsewhere."""
    folders = path.split("/")
    if folders[0] not in ("validation", "parts"):
        return None
    return folders[1] if len(folders) > 2 else ""


def check_plan(plan=None):
    plan = plan or VALIDATION
    components = list(plan)
    return [f"{component} may not see {seen}, which is not before it in the plan"
            for k, component in enumerate(components) for seen in plan[component].split() if seen not in components[:k]]


def check_validation(root):
    findings, lines = check_plan(), {}
    for path in sources.files(root, ("validation",)):
        component, text = component_of(path), sources.read(root, path)
        if component not in VALIDATION:
            findings.append(f"{path}: {component}/ is no component of tools/components.py")
            continue
        lines[component] = lines.get(component, 0) + text.count("\n")
        seen = set(VALIDATION[component].split()) | {component} | ({""} if component == "outside" else set())
        findings += [f"{path}:{line}: {component or 'the entry'} may not see {component_of(name) or 'the entry'} ({name})"
                     for line, name, quoted in sources.includes(text)
                     if quoted and name.startswith("validation/") and component_of(name) not in seen
                     and name != "validation/likely_cause.h"]
    total = sum(lines.values())
    return findings + [f"validation/{component}: {count} of {total} lines, more than a quarter: too large for a component"
                       for component, count in lines.items() if total > 1000 and count > LARGEST_SHARE * total]


def check_parts(root):
    plan = parts(root)
    findings = check_plan(plan) if plan else []
    for path in sources.files(root, ("parts",)):
        part = component_of(path)
        if part not in plan:
            findings.append(f"{path}: {part}/ has no row in parts/CMakeLists.txt")
            continue
        seen = set(plan[part].split()) | {part}
        findings += [f"{path}:{line}: the part {part} may not see {component_of(name)} ({name})"
                     for line, name, quoted in sources.includes(sources.read(root, path))
                     if quoted and name.startswith("parts/") and component_of(name) not in seen]
    return findings + [f"parts/{part}: no README.md of five lines" for part in plan if not (root / "parts" / part / "README.md").is_file()]


def check_links(root):
    """Checks what the CMake targets of components and parts link."""
    plan, findings = {**VALIDATION, **parts(root)}, []
    for path in sorted(p for folder in ("validation", "parts") for p in (root / folder).glob("*/CMakeLists.txt")):
        component = path.parent.name
        seen = set(plan.get(component, "").split()) | {component}
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for target in re.findall(r"ursula::(\w+)", line.split("#")[0]):
                of = VALIDATION if path.parent.parent.name == "validation" else parts(root)
                if target in of and target not in seen:
                    findings.append(f"{path.relative_to(root)}:{number}: {component} may not link ursula::{target}")
    return findings


def check_components(root):
    findings = check_validation(root) + check_parts(root) + check_links(root)
    for path in sources.files(root, ("report",)):
        findings += [f"{path}:{line}: report/ may not see {component_of(name) or 'the entry'} ({name})"
                     for line, name, quoted in sources.includes(sources.read(root, path))
                     if quoted and name.startswith("validation/") and component_of(name) not in REPORT_SEES]
    return findings
