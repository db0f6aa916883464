# Judges a solver process on a machine that `ursula init` writes.
# cmake -D URSULA=… -D WORK=FOLDER -D KIND=UPS [-D FORMAT=urdf] -D SOLVER=… -D CODE=0 -D PATTERN=… -P judge_recipe.cmake
# -D TILTED=1 tilts the platform during the whole motion. The motion takes a fifth of its time, so that replays need
# fewer steps. @MODEL@ in SOLVER is the exported file. The output must match PATTERN, and the exit code must be CODE.
cmake_policy(VERSION 3.25)

include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(0 "" ${URSULA} init my.toml --kind ${KIND})
file(READ ${WORK}/my.toml scenario)
string(REPLACE "time = 1.5" "time = 0.3" scenario "${scenario}")
string(REPLACE "time = 3.0" "time = 0.6" scenario "${scenario}")
if(TILTED)
  string(REPLACE "orientation = [1.0, 0.0, 0.0, 0.0]" "orientation = [0.9848, 0.1736, 0.0, 0.0]" scenario "${scenario}")
  string(REPLACE "orientation = [0.9962, 0.0, 0.0, 0.0872]" "orientation = [0.9848, 0.0868, 0.1228, 0.0868]" scenario "${scenario}")
endif()
file(WRITE ${WORK}/my.toml "${scenario}\n[simulation]\nsamples = 11\n")
set(MODEL ${WORK}/my.${FORMAT})
if(FORMAT)
  run(0 "" ${URSULA} export my.toml --format ${FORMAT} --out ${MODEL})
endif()
string(CONFIGURE "${SOLVER}" command @ONLY)
run(${CODE} "${PATTERN}" ${URSULA} validate my.toml --solver ${command} --solver-timeout 60 --quiet)
