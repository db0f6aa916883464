# Installs into an empty folder, builds the examples there against the installed files, with warnings as errors even in
# our headers, and runs them. cmake -D BUILD=… -D CXX=… -D GENERATOR=… -D EIGEN=… [-D MUJOCO=…] [-D PYTHON=…] -D WORK=…
# -P installed_examples.cmake
cmake_policy(VERSION 3.25)

include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
set(prefix ${WORK}/prefix)
run(0 "" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

# The package forces no options, no definitions and no other library on its users.
file(GLOB_RECURSE exported ${prefix}/lib*/ursula-targets*.cmake)
foreach(file IN LISTS exported)
  file(READ ${file} text)
  if(text MATCHES "INTERFACE_(COMPILE_OPTIONS|COMPILE_DEFINITIONS|LINK_OPTIONS)|-fsanitize|Simbody|fmt")
    message(FATAL_ERROR "${file} forces ${CMAKE_MATCH_0} on users")
  endif()
endforeach()
if(NOT exported)
  message(FATAL_ERROR "no CMake package was installed")
endif()

file(GLOB_RECURSE examples ${prefix}/share/doc/*/examples/CMakeLists.txt)
cmake_path(GET examples PARENT_PATH source)
# The examples of DART and MuJoCo, the dearest to compile, are built and run by tests/recipes/ alone.
run(0 "" ${CMAKE_COMMAND} -S ${source} -B ${WORK}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${CXX} -D DART_LIBRARY=OFF -D MUJOCO_LIBRARY=OFF
  -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_NO_SYSTEM_FROM_IMPORTED=ON "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror -pedantic")
run(0 "" ${CMAKE_COMMAND} --build ${WORK}/build)

# What engines' examples share compiles against the installed files too.
if(EXISTS "${MUJOCO}/mujoco/mujoco.h")
  run(0 "" ${CXX} -std=c++17 -fsyntax-only -Wall -Wextra -Werror -pedantic -I${prefix}/include -isystem ${EIGEN} -I${MUJOCO}
    -I${source}/.. ${source}/engines/mujoco_solver.cpp)
endif()

# The compiler must refuse containers of another layout.
set(compile ${CXX} -std=c++17 -fsyntax-only -I${prefix}/include -I${EIGEN} ${source}/judge_own_solver.cpp)
run(0 "" ${compile} -D_GLIBCXX_ASSERTIONS)
run(1 "ursula was built with other containers of the standard library" ${compile} -D_GLIBCXX_DEBUG)

set(bin ${WORK}/build)
set(helix ${prefix}/share/ursula/scenarios/paper-helix.toml)
run(0 "paper-helix: pass" ${bin}/judge_own_solver ${helix})
run(1 "paper-helix: fail\n.*torque" ${bin}/judge_own_solver ${helix} 1e-11)
run(2 "no-such.toml" ${bin}/judge_own_solver ${WORK}/no-such.toml)
run(0 "3.000 s: .* N m\n.*come back within" ${bin}/inverse_dynamics ${helix})
run(0 "[1-8] real poses of 8; the one commanded is found" ${bin}/all_poses ${helix})
run(0 "400 kg: .*600 kg: [0-9.]+ N m" ${bin}/sweep_by_hand ${helix})
run(0 "heave: pass, report at" ${bin}/machine_in_code ${WORK}/heave)
run(1 "heave: fail.*motion.twist" ${bin}/machine_in_code ${WORK}/wrong 1e-6)
set(mechanisms ${prefix}/share/ursula/scenarios/mechanisms)
run(0 "crank_hinge: .* Nm\naccelerations come back within .*\nfourbar: pass" ${bin}/judge_fourbar ${mechanisms}/fourbar.toml)
run(1 "delta: fail\n.*torque" ${bin}/judge_fourbar ${mechanisms}/delta.toml 1e-6)
run(2 "no-such.toml" ${bin}/judge_fourbar ${WORK}/no-such.toml)
foreach(file summary.json timeseries.csv report.html junit.xml)
  if(NOT EXISTS ${WORK}/heave/${file})
    message(FATAL_ERROR "machine_in_code did not write ${file}")
  endif()
endforeach()

# The same by pkg-config, which meson and make use. Eigen's own file names the place of an installed Eigen.
find_program(PKG_CONFIG NAMES pkg-config pkgconf)
if(PKG_CONFIG)
  file(GLOB_RECURSE pc ${prefix}/lib*/ursula.pc)
  cmake_path(GET pc PARENT_PATH pc_folder)
  set(ENV{PKG_CONFIG_PATH} ${pc_folder}:${EIGEN}/../../share/pkgconfig)
  execute_process(COMMAND ${PKG_CONFIG} --cflags --libs ursula OUTPUT_VARIABLE flags ERROR_VARIABLE refused
    OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE code)
  if(NOT code EQUAL 0 OR NOT flags MATCHES "-lursula")
    message(FATAL_ERROR "pkg-config --cflags --libs ursula: '${flags}' ${refused}")
  endif()
  separate_arguments(flags UNIX_COMMAND "${flags}")
  set(by_hand ${CXX} -std=c++17 ${source}/inverse_dynamics.cpp -I${EIGEN} -o ${WORK}/by_hand)
  run(0 "" ${by_hand} ${flags} -Wl,-rpath,${pc_folder}/..)
  run(0 "3.000 s: .* N m\n.*come back within" ${WORK}/by_hand ${helix})
  run(1 "ursula/" ${by_hand})
endif()
run(0 "[0-9]" ${prefix}/bin/ursula --version)

# Runs the README's program beside a telescopic machine; its efforts of zero must fail.
file(MAKE_DIRECTORY ${WORK}/own)
function(run_own expected pattern)
  run(${expected} "${pattern}" ${CMAKE_COMMAND} -E chdir ${WORK}/own ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${ARGN})
endfunction()
run_own(0 "wrote my.toml" ${prefix}/bin/ursula init my.toml --kind UPS)
run_own(0 "0 warnings" ${prefix}/bin/ursula check my.toml --picture my.svg)
run_own(0 "" ${prefix}/bin/ursula inverse my.toml --out mine.csv)
run_own(0 "verdict: pass" ${prefix}/bin/ursula validate my.toml --torques mine.csv)
run_own(0 "^fail" ${bin}/first)
if(PYTHON)
  file(GLOB module ${prefix}/lib*/python*/*-packages/ursula/__init__.py)
  cmake_path(GET module PARENT_PATH module)
  cmake_path(GET module PARENT_PATH module)
  run(0 "ursula.Scenario 'paper-helix'" ${CMAKE_COMMAND} -E env PYTHONPATH=${module} PYTHONDONTWRITEBYTECODE=1 ${PYTHON} -c
    "print(__import__('ursula').read_scenario(__import__('sys').argv[1]))" ${helix})
  run_own(0 "^fail " PYTHONPATH=${module} ${PYTHON} ${source}/python/first.py)
endif()
