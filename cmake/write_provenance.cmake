# Run at build time (cmake -P): fills provenance.cpp.in; configure_file leaves an unchanged output alone.
# Results and prose do not enter the program, so that refreshing them does not make a build "dirty".
set(COMMIT unknown)
if(GIT)
  set(git ${GIT} -c safe.directory=${SOURCE_DIR} --no-optional-locks -C ${SOURCE_DIR})
  execute_process(COMMAND ${git} rev-parse --show-prefix HEAD
    OUTPUT_VARIABLE answer RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed AND answer MATCHES "^\n([0-9a-f]+)\n$")  # with an empty prefix the checkout is ours and not one around us
    set(COMMIT ${CMAKE_MATCH_1})
    execute_process(COMMAND ${git} status --porcelain --untracked-files=no -- . ":(exclude)results" ":(exclude,glob)**/*.md"
      OUTPUT_VARIABLE changes RESULT_VARIABLE failed ERROR_QUIET)
    if(failed OR NOT changes STREQUAL "")
      string(APPEND COMMIT -dirty)
    endif()
  endif()
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
