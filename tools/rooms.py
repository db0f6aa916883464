"""The plan of validation/: its rooms from the ground up, and which rooms each may see. Includes and CMake targets are held to it."""

import re

import sources

# A room may see those named, which stand above it in this list: so there is no circle and no arrow back up.
ROOMS = {
    "verdict": "",
    "subject": "",
    "picture": "verdict subject",
    "limits": "verdict subject",
    "samples": "verdict subject limits",
    "replay": "verdict subject limits samples",
    "evidence": "subject limits samples replay",
    "checks": "verdict subject limits samples replay evidence",
    "findings": "verdict subject limits samples replay",
    "external": "subject limits samples replay evidence",
    "report": "verdict picture",
    "": "verdict picture subject limits samples evidence checks findings external",  # the front door: validation/*.cpp
    "outside": "verdict subject",  # and the front door
    "prove": "verdict subject limits samples evidence checks report ",  # and the front door
    "audit": "subject replay report",
    "check_scenario": "subject",
    "scenario_docs": "",
    "compare": "verdict report",
    "simulate": "verdict subject",
    "suite": "verdict subject report",
    "stream": "verdict subject findings",
    "map": "verdict subject report stream",
    "sweep": "verdict subject checks findings ",  # and the front door
    "sweep_report": "verdict report sweep",
}
USE_THE_FRONT_DOOR = {"outside", "prove", "sweep"}
LARGEST_SHARE = 0.25  # of validation's lines, in one room


def room_of(path):
    parts = path.split("/")
    return parts[1] if len(parts) > 2 else ""


def allowed(room):
    return set(ROOMS[room].split()) | ({""} if room in USE_THE_FRONT_DOOR else set()) | {room}


def check_plan(plan=None):
    plan = plan or ROOMS
    rooms = list(plan)
    return [f"tools/rooms.py: {room} may not see {seen}, which is not below it"
            for k, room in enumerate(rooms) for seen in plan[room].split() if seen not in rooms[:k]]


def check_rooms(root):
    findings, lines = check_plan(), {}
    for path in sources.files(root, ("validation",)):
        room, text = room_of(path), sources.read(root, path)
        if room not in ROOMS:
            findings.append(f"{path}: {room}/ is no room of tools/rooms.py")
            continue
        lines[room] = lines.get(room, 0) + text.count("\n")
        for line, name, quoted in sources.includes(text):
            if quoted and name.startswith("validation/") and room_of(name) not in allowed(room):
                findings.append(f"{path}:{line}: {room or 'the front door'} may not see {room_of(name) or 'the front door'} ({name})")
    total = sum(lines.values())
    findings += [f"validation/{room}: {count} of {total} lines, more than a quarter: too large for a room"
                 for room, count in lines.items() if total > 1000 and count > LARGEST_SHARE * total]
    return findings + check_room_targets(root)


def check_room_targets(root):
    """What the rooms' CMake targets link."""
    findings = []
    for path in sorted((root / "validation").glob("*/CMakeLists.txt")):
        room = path.parent.name
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for target in re.findall(r"ursula::(\w+)", line.split("#")[0]):
                seen = "" if target == "validation" else target
                if seen in ROOMS and room in ROOMS and seen not in allowed(room):
                    findings.append(f"validation/{room}/CMakeLists.txt:{number}: {room} may not link ursula::{target}")
    return findings
