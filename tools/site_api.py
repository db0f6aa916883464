"""The references of the two libraries as pages: of Python from its stubs and docstrings, of C++ from the public headers."""

import ast
import importlib
import inspect
import re

# The page's sections: a public header, and the headers whose declarations the page shows there.
HEADERS = {
    "scenario": ["model/scenario.h", "model/scenario_json.h", "model/manipulator.h", "model/trajectory.h", "model/trajectories/trajectories.h",
                 "model/motion.h", "model/load.h", "model/instants.h", "model/quaternions.h", "base/errors.h"],
    "solver": ["parts/fast/solver.h", "parts/fast/batch_dynamics.h", "parts/fast/threaded_batch.h",
               "parts/derivatives/effort_derivatives.h", "parts/poses/direct_kinematics.h", "parts/poses/ups_poses.h"],
    "validate": ["validation/subject/subject.h", "validation/validate.h", "validation/outside/outside_solver.h",
                 "validation/validate.h", "validation/verdict/result.h"],
    "mechanism": ["model/mechanism.h", "model/motor_trajectory.h", "model/mechanism_scenario.h", "nocsolver/loops/loop_solver.h",
                  "validation/mechanism/validate_mechanism.h"],
    "report": ["report/files/report.h", "report/files/written_files.h"],
    "studies": ["parts/simulate/simulate.h", "validation/check_scenario/check_scenario.h", "report/page/scenario_picture.h", "parts/map/pose_map.h",
                "parts/compare/compare.h"],
}
ENTITY = re.compile(r"\b(?:class|struct|enum class|enum)\s+(\w+)[^;()]*[{]|\b(?:using)\s+(\w+)|([\w~]+(?:<[^>]*>)?)\s*\(")


def declarations(text):
    """[(comment, declaration)] of the declarations in namespace ursula; one goes on while a brace or parenthesis is open."""
    inside = re.search(r"^namespace ursula[:\w]* \{$(.*)^\}  // namespace ursula", text, re.M | re.S)[1]
    comment, code, depth = [], [], 0
    for line in inside.splitlines():
        bare = line.strip()
        if not code and bare.startswith("///"):
            comment.append(bare[3:].strip())
        elif not code and (not bare or bare.startswith("//") or bare.startswith("#")):
            comment = []
        else:
            code.append(line)
            visible = re.sub(r'"[^"]*"|//.*', "", line)
            depth += sum(visible.count(each) for each in "{(") - sum(visible.count(each) for each in "})")
            if depth == 0 and visible.rstrip().endswith((";", "}")):
                yield " ".join(comment), "\n".join(code)
                comment, code = [], []


def title(code):
    found = ENTITY.search(re.sub(r"^template <[^>]*>\s*", "", code))
    return next((each for each in found.groups() if each), None) if found else None


def entity(comment, code):
    """A public declaration as its comment and its code, without bodies of functions."""
    if not re.search(r"\b(class|struct|enum)\b", code.split("{")[0]):
        code = re.sub(r"\s*\{.*\}\s*$", ";", code, flags=re.S)
    code = re.sub(r"\n private:\n.*?(?=\n\};)", "", code, flags=re.S)
    return (comment + "\n\n" if comment else "") + f"```cpp\n{code}\n```\n"


def escaped(words):
    """Escapes characters of a comment that Markdown would take for marks."""
    spans = re.split(r"(`[^`]*`)", words)
    return "".join(each if each.startswith("`") else re.sub(r"([*_<\[\]])", r"\\\1", each) for each in spans)


def cpp(root):
    out = ["# The C++ library", "",
           "Everything is in namespace `ursula`; `#include <ursula/ursula.h>` brings it all, the headers below a part. It needs C++17 and Eigen 3.4.",
           "In CMake: `find_package(ursula)`, `target_link_libraries(yours PRIVATE ursula::ursula)`. [Judge your solver](solvers.md) has a first program.",
           "`./dev docs` writes the same by Doxygen, with cross references, to `build/api_docs`.", "",
           "SI units throughout. Legs are 0-based. Six-vectors are [angular; linear]. Vectors are in the base's frame B unless the frame is said.", ""]
    for name, files in HEADERS.items():
        header = (root / f"include/ursula/{name}.h").read_text(encoding="utf-8")
        words = " ".join(re.findall(r"^/// (?!\\file)(.*)$", header, re.M))
        out += [f"## `<ursula/{name}.h>`", "", escaped(words), ""]
        for file in files:
            seen = set()
            for comment, code in declarations((root / file).read_text(encoding="utf-8")):
                heading = title(code)
                if heading is None or re.match(r"\s*(class|struct) \w+;\s*$", code):
                    continue
                if heading not in seen:
                    out += [f"### {heading}", ""]
                    seen.add(heading)
                out += [entity(escaped(comment), code), ""]
    return "\n".join(out)


def docstring(module, path, stub):
    """The module's docstring, which says more than the stub's, without the signature that pybind11 puts first."""
    found = module
    for name in path.split("."):
        found = getattr(found, name, None)
    words = inspect.getdoc(found) if found is not None else None
    if not words or "Overloaded function" in words:
        return ast.get_docstring(stub) or ""
    return re.sub(r"^\w+\([^\n]*\n+", "", words) or ast.get_docstring(stub) or ""


def signature(function, is_method):
    arguments = ast.unparse(function.args)
    if is_method:
        arguments = re.sub(r"^self(, )?(\*$)?", "", arguments)
    result = f" -> {ast.unparse(function.returns)}" if function.returns else ""
    line = f"{function.name}({arguments}){result}".replace("npt.ArrayLike", "ArrayLike")
    if len(line) <= 84:
        return line
    # Each argument gets a line; commas within brackets stay.
    each = re.split(r", (?![^\[(]*[\])])", arguments.replace("npt.ArrayLike", "ArrayLike"))
    return f"{function.name}(\n" + "".join(f"    {argument},\n" for argument in each) + f"){result}"


def python(root):
    tree = ast.parse((root / "python/ursula/__init__.pyi").read_text(encoding="utf-8"))
    try:
        module = importlib.import_module("ursula")
    except ImportError:
        module = None
    out = ["# The Python module", "",
           "`import ursula`: NumPy in and out. Rows are instants, units are SI, B is the base's frame and M the platform's.",
           "[Judge your solver](solvers.md) shows the module at work; `help(ursula)` has the same text as this page.", ""]
    functions = [each for each in tree.body if isinstance(each, ast.FunctionDef)]
    classes = [each for each in tree.body if isinstance(each, ast.ClassDef)]
    out += ["## Functions", ""]
    for each in sorted(functions, key=lambda each: each.name):
        out += [f"### {each.name}", "", f"```python\n{signature(each, False)}\n```", "", escaped(docstring(module, each.name, each)), ""]
    for each in classes:
        out += [f"## {each.name}", "", escaped(docstring(module, each.name, each)), ""]
        rows, methods = [], []
        for member in each.body:
            if isinstance(member, ast.AnnAssign):
                rows.append((member.target.id, ast.unparse(member.annotation), ""))
            if not isinstance(member, ast.FunctionDef) or member.name.startswith("__"):
                continue
            words = escaped(docstring(module, f"{each.name}.{member.name}", member))
            if any(isinstance(mark, ast.Name) and mark.id == "property" for mark in member.decorator_list):
                rows.append((member.name, ast.unparse(member.returns), words.replace("\n", " ")))
            else:
                methods += [f"### {each.name}.{member.name}", "", f"```python\n{signature(member, True)}\n```", "", words, ""]
        if rows:
            out += ["| attribute | type | what it is |", "| --- | --- | --- |"]
            out += [f"| `{name}` | `{kind}` | {words} |".replace(" | None", " or None") for name, kind, words in rows] + [""]
        out += methods
    return "\n".join(out)


def write(root, folder):
    (folder / "cpp_api.md").write_text(cpp(root), encoding="utf-8")
    (folder / "python_api.md").write_text(python(root), encoding="utf-8")
