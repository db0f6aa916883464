# A room: one folder of the house as a static library, ursula::NAME. LINKS are the rooms that its headers may name,
# PRIVATE those and the libraries that its sources alone need; tools/check_structure.py holds both to the plan.
function(ursula_room name)
  cmake_parse_arguments(PARSE_ARGV 1 room "" "" "SOURCES;LINKS;PRIVATE")
  add_library(ursula_${name} STATIC ${room_SOURCES})
  add_library(ursula::${name} ALIAS ursula_${name})
  target_link_libraries(ursula_${name} PUBLIC ursula::options ${room_LINKS} PRIVATE fmt::fmt ${room_PRIVATE})
  ursula_use_precompiled(ursula_${name})
  set_property(GLOBAL APPEND PROPERTY URSULA_ROOMS ursula_${name})
endfunction()

# What is compiled together, where sources share much.
function(ursula_unity name batch)
  set_target_properties(ursula_${name} PROPERTIES UNITY_BUILD ${URSULA_UNITY} UNITY_BUILD_BATCH_SIZE ${batch})
endfunction()
