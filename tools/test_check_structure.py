#!/usr/bin/env python3
"""Tests that check_structure.py passes a sound tree and names each defect put into one."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import check_structure  # noqa: E402
import components  # noqa: E402
import named_paths  # noqa: E402
import sources  # noqa: E402


def sound_tree():
    rows = []
    for equation in check_structure.EQUATIONS:
        code, test = "— a definition", "— a definition"
        if equation in ("15a", "15b"):
            code, test = "`nocsolver/leg.cpp`: legRates", "`tests/leg_test.cpp`: Leg.Rates"
        rows.append(f"| ({equation}) | what | {code} | {test} | none |")
    return {
        "base/CMakeLists.txt": "target_link_libraries(b ursula::eigen)\n",
        "model/CMakeLists.txt": "target_link_libraries(m ursula::base)\n",
        "report/CMakeLists.txt": "target_link_libraries(r ursula::verdict)\n",
        "parts/CMakeLists.txt": "ursula_part(engines ADDS addEngines)\nursula_part(fast ADDS addFast)\nursula_part(exchange)\n"
                                "ursula_part(map SEES fast VERBS map)\n",
        "parts/README.md": "`engines/`, `fast/`, `exchange/`, `map/`\n",
        "parts/engines/README.md": "Engines.\n",
        "parts/fast/README.md": "Kernels.\n",
        "parts/exchange/README.md": "Files.\n",
        "parts/map/README.md": "Maps.\n",
        "parts/map/map.cpp": '#include "parts/fast/k.h"\n#include "report/page/page.h"\n',
        "parts/fast/k.h": "#pragma once\n",
        "simbody/CMakeLists.txt": "target_link_libraries(s ursula::model ${Simbody_LIBRARIES})\n",
        "parts/engines/CMakeLists.txt": "target_link_libraries(s ursula::simbody)\n",
        "parts/exchange/CMakeLists.txt": "target_link_libraries(x ursula::model tinyxml2::tinyxml2)\n",
        "nocsolver/CMakeLists.txt": "target_link_libraries(n ursula::model)  # never Simbody\n",
        "parts/fast/CMakeLists.txt": "target_link_libraries(p ursula::nocsolver TBB::tbb)\n",
        "validation/CMakeLists.txt": "target_link_libraries(v ursula::nocsolver ursula::simbody)\n",
        "model/machine.h": "#include <Eigen/Core>\n",
        "simbody/simbody_loop.h": "// SimTK stays behind this header.\n",
        "simbody/simbody_loop_internal.h": "#include <Simbody.h>\nSimTK::State s;\n",
        "simbody/simbody_loop.cpp": '#include "simbody/simbody_loop_internal.h"\n#include "simbody/simbody_loop.h"\n',
        "nocsolver/leg.h": '#include "model/machine.h"\n',
        "nocsolver/leg.cpp": '#include "nocsolver/leg.h"\nvoid legRates();  // (paper, eqs. 15a–b)\n',
        "validation/replay/replay.cpp": '#include "simbody/simbody_loop.h"\n#include "nocsolver/leg.h"\n',
        "validation/verdict/result.h": "// Verdicts.\n",
        "validation/verdict/CMakeLists.txt": "ursula_component(verdict)\n",
        "validation/checks/engines.cpp": '#include "validation/verdict/result.h"\n#include "validation/replay/replay.h"\n',
        "validation/replay/replay.h": "// Replays.\n",
        "include/ursula/solver.h": '#include <ursula/build.h>\n#include "nocsolver/leg.h"\n',
        "examples/loop.cpp": "#include <ursula/solver.h>\n#include <vector>\n",
        "python/module.cpp": "#include <pybind11/pybind11.h>\n#include <ursula/solver.h>\n",
        "report/page/page.cpp": '#include "validation/verdict/result.h"\n',
        "apps/suite/suite.cpp": '#include "report/page/page.h"\n#include "validation/validate.h"\n',
        "report/page/page.h": "// Pages.\n",
        "validation/validate.h": "// The front door.\n",
        "apps/main.cpp": '#include "model/machine.h"\n',
        "tests/support.h": '#include "nocsolver/leg.h"\n',
        "tests/leg_test.cpp": '#include "support.h"\nTEST(Leg, Rates) {}\n',
        "validation/README.md": "Start with `validate.h`; see `checks/` and `verdict/`, and `replay/`. `NAME.cpp` stands for any.\n",
        "docs/equations.md": "\n".join(["| equation | says | code | test | deviation |", "|---|---|---|---|---|"] + rows) + "\n",
    }


class CheckStructure(unittest.TestCase):
    def findings(self, **changes):
        """The findings in the sound tree after `path=(old, new)`; an empty old appends; `__` stands for / and `_DOT_` for a point."""
        tree = sound_tree()
        for path, (old, new) in changes.items():
            path = path.replace("__", "/").replace("_DOT_", ".")
            before = tree.get(path, "")
            tree[path] = before.replace(old, new) if old else before + new
            self.assertNotEqual(tree[path], before, "the defect did not get into the tree")
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for path, text in tree.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            return (check_structure.check_includes(root) + check_structure.check_type_names(root)
                    + check_structure.check_targets(root) + check_structure.check_headers(root) + components.check_components(root)
                    + check_structure.check_equations(root) + named_paths.check_paths(root) + named_paths.check_subfolders(root))

    def assert_caught(self, expected, **changes):
        findings = self.findings(**changes)
        self.assertTrue(any(expected in f for f in findings), f"{expected!r} not among {findings}")

    def test_sound_tree_passes(self):
        self.assertEqual(self.findings(), [])

    def test_include_rules(self):
        append = lambda text: ("", text)  # noqa: E731
        self.assert_caught("the solver may not see an engine", nocsolver__leg_DOT_cpp=append("#include <Simbody.h>\n"))
        self.assert_caught("the solver may not see an engine", nocsolver__leg_DOT_cpp=append('#include "simbody/simbody_loop.h"\n'))
        self.assert_caught("leg.h -> model/machine.h -> simbody/simbody_loop.h",
                           model__machine_DOT_h=append('#include "simbody/simbody_loop.h"\n'))
        self.assert_caught("the solver may not see the engines' geometry", nocsolver__leg_DOT_cpp=append('#include "model/legs/leg.h"\n'))
        self.assert_caught("may not see the solver", simbody__simbody_loop_DOT_cpp=append('#include "nocsolver/leg.h"\n'))
        self.assert_caught("the solver may not see an engine", nocsolver__leg_DOT_cpp=append("#include <mujoco/mujoco.h>\n"))
        self.assert_caught("an engine may not see another",
                           parts__engines__mujoco__mujoco_loop_DOT_cpp=append('#include "simbody/simbody_loop.h"\n'))
        self.assert_caught("nocsolver/ may not include parts/", nocsolver__noc__n_DOT_h=("", '#include "parts/fast/k.h"\n'))
        self.assert_caught("nocsolver/legs may not include nocsolver/noc", nocsolver__noc__n_DOT_h=("", "#pragma once\n"),
                           nocsolver__legs__l_DOT_h=("", '#include "nocsolver/noc/n.h"\n'))
        self.assert_caught("the kernels may not see the NOC", nocsolver__noc__n_DOT_h=("", "#pragma once\n"),
                           parts__fast__k_DOT_h=("", '#include "nocsolver/noc/n.h"\n'))
        for core in ("model__machine_DOT_h", "validation__validate_DOT_h", "report__page__page_DOT_h", "apps__main_DOT_cpp"):
            self.assert_caught("may not include parts/", **{core: append('#include "parts/fast/k.h"\n')})
        self.assert_caught("model/ may not include nocsolver/", model__machine_DOT_h=append('#include "nocsolver/leg.h"\n'))
        self.assert_caught("which is internal", validation__r_DOT_h=append('#include "simbody/simbody_loop_internal.h"\n'))
        self.assert_caught("is no file of this project", nocsolver__leg_DOT_cpp=append('#include "leg.h"\n'))

    def test_users_of_the_library(self):
        self.assert_caught("users of the library do not have boost/version.hpp (include/ursula/solver.h -> nocsolver/leg.h -> "
                           "boost/version.hpp)", nocsolver__leg_DOT_h=("", "#include <boost/version.hpp>\n"))
        self.assert_caught("users of the library do not have fmt/format.h", examples__loop_DOT_cpp=("", "#include <fmt/format.h>\n"))
        self.assert_caught("examples/ may not include nocsolver/", examples__loop_DOT_cpp=("", '#include "nocsolver/leg.h"\n'))
        self.assert_caught("users of the library do not have fmt/format.h", python__module_DOT_cpp=("", "#include <fmt/format.h>\n"))
        self.assert_caught("users of the library do not have pybind11/numpy.h",
                           examples__loop_DOT_cpp=("", "#include <pybind11/numpy.h>\n"))
        self.assert_caught("python/ may not include nocsolver/", python__module_DOT_cpp=("", '#include "nocsolver/leg.h"\n'))
        self.assert_caught("model/ may not include include/", model__machine_DOT_h=("", '#include "include/ursula/solver.h"\n'))

    def test_type_names(self):
        of = "namespace ursula {\nstruct State {\n};\n}\n"
        self.assert_caught("ursula::State is in nocsolver/a.h, too", parts__engines__a_DOT_h=("", of), nocsolver__a_DOT_h=("", of))
        elsewhere = of.replace("ursula", "ursula::direct")
        self.assertEqual(self.findings(parts__engines__a_DOT_h=("", of), nocsolver__a_DOT_h=("", elsewhere)), [])

    def test_simtk_in_headers(self):
        self.assert_caught("SimTK in a header", simbody__simbody_loop_DOT_h=("", "const SimTK::State& s();\n"))
        self.assert_caught("Simbody.h in a header", validation__r_DOT_h=("", "#include <Simbody.h>\n"))
        self.assert_caught("mujoco.h in a header", validation__r_DOT_h=("", "#include <mujoco/mujoco.h>\n"))
        self.assertEqual(self.findings(model__machine_DOT_h=("", "/* SimTK */ // SimTK\n")), [])

    def test_targets(self):
        self.assert_caught("exchange may not link", parts__exchange__CMakeLists_DOT_txt=("", "link(ursula::nocsolver)\n"))
        self.assert_caught("nocsolver may not link", nocsolver__CMakeLists_DOT_txt=("", "link(${Simbody_LIBRARIES})\n"))
        self.assert_caught("nocsolver may not link", nocsolver__CMakeLists_DOT_txt=("", "link(TBB::tbb)\n"))
        self.assert_caught("simbody may not link", simbody__CMakeLists_DOT_txt=("", "link(ursula::nocsolver)\n"))
        self.assert_caught("use ursula_use_cold()", base__CMakeLists_DOT_txt=("", "target_compile_options(b PRIVATE -O1)\n"))
        self.assert_caught("base may not link", base__CMakeLists_DOT_txt=("", "link(ursula::model)\n"))
        self.assert_caught("model may not link", model__CMakeLists_DOT_txt=("", "link(ursula::nocsolver)\n"))

    def test_components(self):
        self.assert_caught("verdict may not see checks", validation__checks__a_DOT_h=("", "\n"),
                           validation__verdict__result_DOT_h=("", '#include "validation/checks/a.h"\n'))
        self.assert_caught("replay may not see the entry",
                           validation__replay__replay_DOT_cpp=("", '#include "validation/validate.h"\n'))
        self.assert_caught("validation/ may not include report/", validation__validate_DOT_h=("", '#include "report/page/page.h"\n'))
        self.assert_caught("report/ may not see replay", report__page__page_DOT_h=("", '#include "validation/replay/replay.h"\n'))
        self.assert_caught("the part map may not see engines", parts__engines__e_DOT_h=("", "\n"),
                           parts__map__map_DOT_cpp=("", '#include "parts/engines/e.h"\n'))
        self.assert_caught("map may not link ursula::engines", parts__map__CMakeLists_DOT_txt=("", "link(ursula::engines)\n"))
        self.assert_caught("shed/ has no row", parts__shed__a_DOT_cpp=("", "\n"))
        self.assert_caught("parts/poses: no README.md", parts__CMakeLists_DOT_txt=("ursula_part(map", "ursula_part(poses)\nursula_part(map"))
        self.assert_caught("attic/ is no component", validation__attic__a_DOT_cpp=("", "\n"))
        self.assert_caught("verdict may not link ursula::checks",
                           validation__verdict__CMakeLists_DOT_txt=("", "target_link_libraries(v ursula::checks)\n"))
        self.assert_caught("too large for a component", validation__checks__a_DOT_cpp=("", "\n" * 2000))

    def test_plan_of_components(self):
        self.assertEqual(components.check_plan(), [])
        self.assertTrue(components.check_plan({"a": "b", "b": ""}))

    def test_map_against_code(self):
        self.assert_caught("which carries no tag (paper, eq. 15b)", nocsolver__leg_DOT_cpp=("15a–b", "15a"))
        self.assert_caught("tagged with (36)", nocsolver__leg_DOT_cpp=("", "// (paper, eq. 36)\n"))
        self.assert_caught("tagged with (51c)", model__machine_DOT_h=("", "// (paper, eq. 51)\n"))
        self.assert_caught("does not have legSpeeds", docs__equations_DOT_md=("legRates", "legSpeeds"))
        self.assert_caught("does not have Leg.Speeds", docs__equations_DOT_md=("Leg.Rates", "Leg.Speeds"))
        self.assert_caught("there is no nocsolver/lag.cpp", docs__equations_DOT_md=("leg.cpp", "lag.cpp"))

    def test_map_itself(self):
        row = "| (7) | what | — a definition | — a definition | none |\n"
        self.assert_caught("no row for (7)", docs__equations_DOT_md=(row, ""))
        self.assert_caught("(7) has a row already", docs__equations_DOT_md=("", row))
        self.assert_caught("no equation (56)", docs__equations_DOT_md=("", row.replace("(7)", "(56)")))
        self.assert_caught("no equation (15)", docs__equations_DOT_md=("", row.replace("(7)", "(15)")))
        self.assert_caught("neither code nor a reason", docs__equations_DOT_md=(row, row.replace("— a definition", "—")))
        self.assert_caught("five filled cells", docs__equations_DOT_md=(row, "| (7) | what | none |\n"))

    def test_named_paths(self):
        self.assert_caught("validation/README.md:2: there is no tools/rooms.py", validation__README_DOT_md=("", "`tools/rooms.py`\n"))
        self.assert_caught("validation/README.md:1: there is no verify.h", validation__README_DOT_md=("validate.h", "verify.h"))
        self.assert_caught("docs/a.md:1: there is no model/cars/", docs__a_DOT_md=("", "`model/cars/`"))
        self.assert_caught("leg.cpp:3: there is no model/machine.cpp", nocsolver__leg_DOT_cpp=("", "// As in model/machine.cpp.\n"))
        self.assert_caught("base/CMakeLists.txt:2: there is no cmake/a.cmake", base__CMakeLists_DOT_txt=("", "# See cmake/a.cmake.\n"))
        self.assert_caught("tools/a.py:1: there is no tools/b.py", tools__a_DOT_py=("", f"# As tools/b.{'py'} does.\n"))
        self.assert_caught("validation/README.md: does not name replay/", validation__README_DOT_md=(", and `replay/`", ""))
        self.assertEqual(self.findings(nocsolver__leg_DOT_cpp=("", '// As in model/machine.h.\nauto s = "model/none.h";\n')), [])

    def test_malformed_tags(self):
        for tag in ("(paper, eq 7)", "(paper, eq. 99)", "(paper, eq. 7a)", "(paper, eq. b)", "(paper eq. 7)", "(paper, eq.\n// 7)"):
            self.assert_caught("cannot read the tag", model__machine_DOT_h=("", f"// {tag}\n"))
        self.assertEqual(self.findings(model__machine_DOT_h=("", "// (paper, Fig. 3)\n")), [])

    def test_equation_lists(self):
        read = check_structure.parse_equations
        self.assertEqual(read("15"), ["15a", "15b"])
        self.assertEqual(read("(15a)"), ["15a"])
        self.assertEqual(read("4a–c, 13 and 22-24"), ["4a", "4b", "4c", "13", "22", "23", "24"])
        self.assertEqual(read("14b–16"), ["14b", "15a", "15b", "16"])
        for wrong in ("", "0", "56", "1a", "4a–", "x", "15c"):
            self.assertIsNone(read(wrong), wrong)

    def test_sources(self):
        self.assertEqual(sources.code_only('a /* SimTK\n */ b // SimTK\n"SimTK" c').split(), ["a", "b", "c"])


if __name__ == "__main__":
    unittest.main()
