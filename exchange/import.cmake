# Other people's files, in and out: raw parameters alone, never the solver, never an engine.
find_path(URSULA_TINYXML2_INCLUDE_DIR tinyxml2.h REQUIRED)
find_library(URSULA_TINYXML2_LIBRARY tinyxml2 REQUIRED)
mark_as_advanced(URSULA_TINYXML2_INCLUDE_DIR URSULA_TINYXML2_LIBRARY)

add_library(ursula_import STATIC
  import.cpp
  scenario_text.cpp
  read/drake.cpp
  read/mjcf.cpp
  read/mjcf_inertia.cpp
  read/mjcf_settings.cpp
  read/sdf.cpp
  read/sdf_frames.cpp
  read/small_yaml.cpp
  read/urdf.cpp
  read/urdf_closures.cpp
  read/xml.cpp
  recognise/chains.cpp
  recognise/groups.cpp
  recognise/leg_numbers.cpp
  recognise/leg_shape.cpp
  recognise/link_numbers.cpp
  recognise/motion.cpp
  recognise/recognise.cpp
)
add_library(ursula::import ALIAS ursula_import)
target_include_directories(ursula_import SYSTEM PRIVATE ${URSULA_TINYXML2_INCLUDE_DIR})
target_link_libraries(ursula_import PUBLIC ursula::model PRIVATE fmt::fmt ${URSULA_TINYXML2_LIBRARY})
ursula_use_precompiled(ursula_import)
