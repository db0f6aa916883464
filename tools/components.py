"""The plan of validation/ and studies/: their components from the ground up, and which components each may see. Includes and CMake
targets are checked against it. check_structure.py has the plan of the top-level folders."""

import re

import sources

# A component may see those named, which stand above it in this list; so there is no circle and no arrow back up. Every component of
# studies/ may also see the entry, validation/*.cpp, and report/.
VALIDATION = {
    "verdict": "",
    "subject": "",
    "limits": "verdict subject",
    "samples": "verdict subject limits",
    "replay": "verdict subject limits samples",
    "evidence": "subject limits samples replay",
    "checks": "verdict subject limits samples replay evidence",
    "findings": "verdict subject limits samples replay",
    "mistakes": "verdict subject limits",
    "causes": "verdict subject limits samples replay evidence mistakes",
    "": "verdict subject limits samples evidence checks findings causes",  # the entry: validation/*.cpp
    "outside": "verdict subject ",
}
STUDIES = {
    "random": "subject limits",
    "prove": "verdict subject limits samples evidence checks random",
    "audit": "subject replay",
    "check_scenario": "subject",
    "scenario_docs": "",
    "compare": "verdict",
    "simulate": "verdict subject causes",
    "suite": "verdict subject",
    "stream": "verdict subject findings",
    "map": "verdict subject stream",
    "engines": "verdict subject",
    "sweep": "verdict subject checks findings",
    "sweep_report": "verdict sweep",
    "identify": "verdict subject findings random",
}
COMPONENTS = {**VALIDATION, **STUDIES}
FOLDERS = {"validation": VALIDATION, "studies": STUDIES}
REPORT_SEES = {"verdict", "subject"}  # of validation/
LARGEST_SHARE = 0.25  # of a folder's lines, in one component


def component_of(path):
    """The component of a path in validation/ or studies/; "" for the entry, None elsewhere."""
    parts = path.split("/")
    if parts[0] not in FOLDERS:
        return None
    return parts[1] if len(parts) > 2 else ""


def allowed(component):
    entry = {""} if component in STUDIES or component == "outside" else set()
    return set(COMPONENTS[component].split()) | entry | {component}


def check_plan(plan=None):
    plan = plan or COMPONENTS
    components = list(plan)
    return [f"tools/components.py: {component} may not see {seen}, which is not below it"
            for k, component in enumerate(components) for seen in plan[component].split() if seen not in components[:k]]


def check_components(root):
    findings = check_plan()
    for folder, plan in FOLDERS.items():
        lines = {}
        for path in sources.files(root, (folder,)):
            component, text = component_of(path), sources.read(root, path)
            if component not in plan:
                findings.append(f"{path}: {component}/ is no component of tools/components.py")
                continue
            lines[component] = lines.get(component, 0) + text.count("\n")
            findings += [f"{path}:{line}: {component or 'the entry'} may not see {component_of(name) or 'the entry'} ({name})"
                         for line, name, quoted in sources.includes(text)
                         if quoted and component_of(name) is not None and component_of(name) not in allowed(component)]
        total = sum(lines.values())
        findings += [f"{folder}/{component}: {count} of {total} lines, more than a quarter: too large for a component"
                     for component, count in lines.items() if total > 1000 and count > LARGEST_SHARE * total]
    for path in sources.files(root, ("report",)):
        findings += [f"{path}:{line}: report/ may not see {component_of(name) or 'the entry'} ({name})"
                     for line, name, quoted in sources.includes(sources.read(root, path))
                     if quoted and component_of(name) is not None and component_of(name) not in REPORT_SEES]
    return findings + check_component_targets(root)


def check_component_targets(root):
    """Checks what the components' CMake targets link."""
    findings = []
    for path in sorted(p for folder in FOLDERS for p in (root / folder).glob("*/CMakeLists.txt")):
        component = path.parent.name
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for target in re.findall(r"ursula::(\w+)", line.split("#")[0]):
                seen = "" if target == "validation" else target
                if seen in COMPONENTS and component in COMPONENTS and seen not in allowed(component):
                    findings.append(f"{path.relative_to(root)}:{number}: {component} may not link ursula::{target}")
    return findings
