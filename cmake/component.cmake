# A component: one folder as a static library, ursula::NAME. LINKS are the components that its headers may name; PRIVATE
# are components and libraries that only its sources need. COLD code is compiled at -O1. tools/check_structure.py compares
# links with the plan.
function(ursula_component name)
  cmake_parse_arguments(PARSE_ARGV 1 component "COLD" "" "SOURCES;LINKS;PRIVATE")
  add_library(ursula_${name} STATIC ${component_SOURCES})
  add_library(ursula::${name} ALIAS ursula_${name})
  target_link_libraries(ursula_${name} PUBLIC ursula::options ${component_LINKS} PRIVATE fmt::fmt ${component_PRIVATE})
  if(component_COLD)
    ursula_use_cold(ursula_${name})
  else()
    ursula_use_hot(ursula_${name})
  endif()
  list(LENGTH component_SOURCES count)
  if(count GREATER 1)
    ursula_unity(${name} 6)
  endif()
  set_property(GLOBAL APPEND PROPERTY URSULA_COMPONENTS ursula_${name})
endfunction()

# Compiles `batch` sources together, because they include the same headers and templates. So two sources of a folder may
# not give one name to different things, not even in unnamed namespaces. The preset `dev` compiles each source alone.
function(ursula_unity name batch)
  set_target_properties(ursula_${name} PROPERTIES UNITY_BUILD ${URSULA_UNITY} UNITY_BUILD_BATCH_SIZE ${batch})
endfunction()
