#!/usr/bin/env python3
"""Makes tables and figures' data from the benchmarks' measurements, and measures how the cost of `ursula validate` grows.

    tools/performance.py BENCHMARKS.json FOLDER [--ursula PROGRAM]

BENCHMARKS.json is the output of build/bench/ursula_bench with repetitions. FOLDER gets medians.csv, performance.json and
README.md, and with --ursula scenarios.csv. tools/performance.gp draws the figures.
"""

import argparse
import csv
import io
import json
import os
import platform
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("libsimbody3.7", "libmujoco2.2.2", "libdart6.12", "libeigen3-dev", "libbenchmark1debian", "g++-12")
BATCH = "ursula, batch "
OWN = ("ursula", "ursula, T formed")
SAMPLES = 1000  # of the batches in the table; their data fit into the cache
SCENARIOS, JOBS, TIMES = (1, 2, 4), (1, 2), 3


def write(path, text):
    """Writes the file whole or not at all."""
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=path.parent, delete=False) as file:
        file.write(text)
    os.chmod(file.name, 0o644)
    os.replace(file.name, path)


def write_csv(path, header, rows):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    write(path, text.getvalue())


def medians(benchmarks):
    """{(task, who, how many): (median, lower quartile, upper quartile, repetitions)} of the time of one pose, s."""
    times = {}
    for run in benchmarks:
        if run["run_type"] != "iteration" or "per_pose" not in run:
            continue
        task, who, *count = run["run_name"].removesuffix("/real_time").split("/")
        times.setdefault((task, who, int(count[0]) if count else 1), []).append(run["per_pose"])
    out = {}
    for key, values in sorted(times.items()):
        quartiles = statistics.quantiles(values, n=4) if len(values) > 1 else 3 * values
        out[key] = (statistics.median(values), quartiles[0], quartiles[2], len(values))
    return out


def agreements(context):
    """{(who, task): "2.6e-15"}"""
    out = {}
    for key, text in context.items():
        if key.startswith("agreement/"):
            _, who, task = key.split("/")
            out[who, task] = text.split(": ")[1].split(" of the largest")[0]
    return out


def processor():
    model = platform.processor()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.is_file():
        fields = dict(line.split("\t:", 1) if "\t:" in line else (line.partition(":")[0].strip(), line.partition(":")[2])
                      for line in cpuinfo.read_text(encoding="utf-8").split("\n\n")[0].splitlines() if ":" in line)
        fields = {key.strip(): value.strip() for key, value in fields.items()}
        model = f"{fields.get('model name', model)}, family {fields.get('cpu family')}, model {fields.get('model')}, " \
                f"{float(fields.get('cpu MHz', 0)) / 1000:.2g} GHz"
    return model


def machine(context):
    return f"{processor()}, {context['num_cpus']} hardware threads, {context['best_instructions']}"


def candidate(name):
    """The version of the package that ./dev would unpack."""
    done = subprocess.run(["apt-cache", "policy", name], capture_output=True, text=True, check=False)
    return next((line.split(":", 1)[1].strip() for line in done.stdout.splitlines() if "Candidate:" in line), "")


def packages():
    found = {}
    for name in PACKAGES:
        try:
            done = subprocess.run(["dpkg-query", "-W", "-f=${Version}", name], capture_output=True, text=True, check=False)
        except FileNotFoundError:
            break
        if done.returncode == 0:
            found[name] = done.stdout
        elif Path(".deps").is_dir() and (version := candidate(name)):
            found[name] = f"{version}, unpacked"
    return found


# --- how validate grows -----------------------------------------------------------------------------------------------

def grow_with_scenarios(program):
    """[(scenarios, jobs, median wall time)]: copies of the paper's helix, all settings in turn."""
    text = (ROOT / "scenarios/paper-helix.toml").read_text(encoding="utf-8")
    times = {(count, jobs): [] for count in SCENARIOS for jobs in JOBS}
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for k in range(max(SCENARIOS)):
            files.append(Path(folder) / f"helix-{k}.toml")
            files[-1].write_text(text.replace('name = "paper-helix"', f'name = "helix-{k}"'), encoding="utf-8")
        for _ in range(TIMES):
            for (count, jobs), values in times.items():
                start = time.perf_counter()
                subprocess.run([program, "validate", *map(str, files[:count]), "--jobs", str(jobs), "--quiet", "--out",
                                f"{folder}/out"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                values.append(time.perf_counter() - start)
    return [(count, jobs, statistics.median(values)) for (count, jobs), values in times.items()]


# --- words ------------------------------------------------------------------------------------------------------------

def micro(entry, digits=3):
    return f"{1e6 * entry[0]:.{digits}g}" if entry else "—"


def times_ours(entry, ours):
    return f"{entry[0] / ours[0]:.3g}" if entry and ours else "—"


def side_by_side(found, agree):
    ours = {task: found[task, "ursula", 1] for task in ("inverse", "direct")}
    rows = {}
    for (task, who, count), entry in found.items():
        if task in ("inverse", "direct", "inverse_with_kinematics"):
            rows.setdefault(who, {})[task] = entry
        if task == "samples" and count == SAMPLES:
            what, instructions = who.split(" ", 1)
            rows.setdefault(BATCH + instructions, {})[what] = entry
    for who in OWN:  # ours begin with the platform's motion, so both are the same
        rows[who]["inverse_with_kinematics"] = rows[who]["inverse"]
    for who in rows:
        if who.startswith(BATCH):
            rows[who]["inverse_with_kinematics"] = rows[who]["inverse"]
    lines = ["| engine | inverse, µs | with kinematics, µs | times ursula's | direct, µs | times ursula's | disagreement, inverse | direct |",
             "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for who, row in sorted(rows.items(), key=lambda item: item[1].get("inverse", item[1]["direct"])[0]):
        inverse, direct = row.get("inverse"), row.get("direct")
        only_with = who in OWN or who.startswith(BATCH)
        lines.append(f"| {who} | {'' if only_with else micro(inverse)} | {micro(row.get('inverse_with_kinematics'))} | "
                     f"{times_ours(inverse, ours['inverse'])} | {micro(direct)} | {times_ours(direct, ours['direct'])} | "
                     f"{agree.get((who, 'inverse'), '—')} | {agree.get((who, 'direct'), '—')} |")
    return lines


def kinds(found):
    lines = ["| machine | inverse, µs | in a batch of 64, µs | direct, µs |", "| --- | --- | --- | --- |"]
    for name in [who for task, who, _ in found if task == "inverse_of_kind"]:
        cells = [micro(found.get((task, name, 1))) for task in ("inverse_of_kind", "inverse_batch_of_kind", "direct_of_kind")]
        lines.append(f"| `{name}` | {' | '.join(cells)} |")
    return lines


def others(found):
    lines = ["| what | µs |", "| --- | --- |", f"| joints' motion by the closed forms | {micro(found['kinematics', 'ursula', 1])} |"]
    lines += [f"| direct kinematics: {who} | {micro(entry)} |" for (task, who, _), entry in found.items() if task == "direct_kinematics"]
    lines += [f"| efforts of a mechanism: {who} | {micro(entry)} |" for (task, who, _), entry in found.items() if task == "inverse_of_mechanism"]
    lines += [f"| simulation of the helix of 3 s to 2e-9 m: {who} | {micro(entry)} |" for (task, who, _), entry in found.items() if task == "simulation"]
    return lines


def derivatives(found):
    lines = ["| machine | efforts by the state, 6 × 18, µs | by every number of the machine, µs | regressor, µs |", "| --- | --- | --- | --- |"]
    for name in [who for task, who, _ in found if task == "derivatives_by_state"]:
        cells = [micro(found.get((task, name, 1))) for task in ("derivatives_by_state", "derivatives_by_parameters", "regressor")]
        lines.append(f"| `{name}` | {' | '.join(cells)} |")
    return lines


def threads(found):
    lines = ["| batch of 100,000 poses | one thread, ns a pose | two threads | times as fast |", "| --- | --- | --- | --- |"]
    for task in ("inverse", "direct"):
        one, two = found["threads", task, 1][0], found["threads", task, 2][0]
        lines.append(f"| {task} | {1e9 * one:.3g} | {1e9 * two:.3g} | {one / two:.3g} |")
    return lines


def readme(found, context, scenarios):
    spread = statistics.median((high - low) / middle for middle, low, high, _ in found.values())
    repetitions = max(entry[3] for entry in found.values())
    versions = "; ".join(f"{name} {version}" for name, version in packages().items())
    lines = [
        "# Performance, measured", "",
        "`./dev results performance` makes this page. [docs/performance.md](../../docs/performance.md) says what is measured, how, and how peers are used.", "",
        f"- Machine: {machine(context)}. It is shared, and its speed varies: load average "
        f"{', '.join(f'{x:.2g}' for x in context['load_avg'])} at the start. Half of the repetitions lie within {100 * spread:.0f} % "
        "(median over the benchmarks). Compare ratios, not times of different days.",
        f"- Build: commit `{context['commit']}`, {context['compiler']}, `{context['flags']}`; kernels of batches by instruction set.",
        f"- Library builds, as Debian ships them: {versions or 'unknown'}.",
        f"- Medians of {repetitions} repetitions in random order, all in one process; CPU time, except for threads.", "",
        "## Side by side on the paper's helix", "",
        "The times are of one pose. Peers begin with the joints' motion in their own coordinates. ursula begins with the platform's motion. *With kinematics*, the "
        "closed forms first find the joints' motion from it. *Times ursula's* is relative to `ursula`, one pose at a time. For peers it is without the kinematics, in their favour. Batches have 1,000 poses on one thread. The disagreement is the "
        "largest difference from the paper's equations, over the largest effort or acceleration. It was checked before anything was timed.", "",
        *side_by_side(found, agreements(context)), "",
        "Debian's Simbody is not built for speed. A native Release build is two to three times faster. *MuJoCo, soft* is `mj_forward` "
        "with its own constraints, which leave out J̇ q̇ and yield. *MuJoCo* and *DART* are their trees, closed exactly by their own Jacobians.", "",
        "### Measured elsewhere, not here", "",
        "Debian does not package these engines. They ran on one core of another machine (Zen 5, 4.5 GHz, AVX-512), so their times do not compare with those above.", "",
        "| engine | inverse, µs | with kinematics, µs | direct, µs |", "| --- | --- | --- | --- |",
        "| Pinocchio 3.7 | 3.6 | 4.4 | 6.5 |", "| RBDL | 15 | — | 11.5 |", "| Chrono | — | — | 71 |", "",
        "## How cost grows", "", "![Samples](figures/samples.svg)", "", *threads(found), "", "![Threads](figures/threads.svg)", ""]
    if scenarios:
        lines += ["| `ursula validate`, copies of the paper's helix | jobs | wall time, s |", "| --- | --- | --- |",
                  *(f"| {count} | {jobs} | {seconds:.3g} |" for count, jobs, seconds in scenarios), "",
                  "![Scenarios](figures/scenarios.svg)", ""]
    lines += ["## Other machines and tasks", "", *kinds(found), "", *derivatives(found), "", *others(found), ""]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("benchmarks", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--ursula", help="the program, to measure validate as well")
    arguments = parser.parse_args()
    raw = json.loads(arguments.benchmarks.read_text(encoding="utf-8"))
    found, context = medians(raw["benchmarks"]), raw["context"]
    scenarios = grow_with_scenarios(arguments.ursula) if arguments.ursula else []
    arguments.folder.mkdir(parents=True, exist_ok=True)
    columns = ("task", "who", "count", "median_s", "lower_quartile_s", "upper_quartile_s", "repetitions")
    rows = [(*key, *(f"{x:.4g}" for x in entry[:3]), entry[3]) for key, entry in found.items()]
    write_csv(arguments.folder / "medians.csv", columns, rows)
    if scenarios:
        write_csv(arguments.folder / "scenarios.csv", ("scenarios", "jobs", "wall_s"), [(n, j, f"{s:.4g}") for n, j, s in scenarios])
    kept = {key: context[key] for key in ("date", "num_cpus", "load_avg", "commit", "compiler", "flags", "best_instructions")}
    kept |= {"machine": machine(context), "packages": packages(),
             "agreement": {key.split("/", 1)[1]: text for key, text in context.items() if key.startswith("agreement/")}}
    times = [dict(zip(columns, (*key, *entry))) for key, entry in found.items()]
    write(arguments.folder / "performance.json", json.dumps({"context": kept, "times": times}, indent=1, ensure_ascii=False) + "\n")
    write(arguments.folder / "README.md", readme(found, context, scenarios))


if __name__ == "__main__":
    main()
