# Run at build time (cmake -P): fills provenance.cpp.in; configure_file leaves an unchanged output alone. DEPFILE gets
# the files that the answer depends on. Results and prose do not enter the program, so that refreshing them does not
# make a build "dirty".
set(COMMIT unknown)
set(needs "")
set(counted -- . ":(exclude)results" ":(exclude,glob)**/*.md")
if(GIT)
  set(git ${GIT} -c safe.directory=${SOURCE_DIR} --no-optional-locks -C ${SOURCE_DIR})
  execute_process(COMMAND ${git} rev-parse --show-prefix HEAD
    OUTPUT_VARIABLE answer RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed AND answer MATCHES "^\n([0-9a-f]+)\n$")  # with an empty prefix the checkout is ours and not one around us
    set(COMMIT ${CMAKE_MATCH_1})
    execute_process(COMMAND ${git} ls-files ${counted} OUTPUT_VARIABLE tracked)
    execute_process(COMMAND ${git} symbolic-ref -q HEAD OUTPUT_VARIABLE branch OUTPUT_STRIP_TRAILING_WHITESPACE)
    set(places HEAD logs/HEAD ${branch})  # a detached HEAD has no branch
    list(TRANSFORM places REPLACE "(.+)" "--git-path;\\1")
    execute_process(COMMAND ${git} rev-parse --path-format=absolute ${places} OUTPUT_VARIABLE places)
    string(REGEX REPLACE "([^\n]+)\n" "${SOURCE_DIR}/\\1\n" tracked "${tracked}")
    string(STRIP "${tracked}${places}" needs)
    execute_process(COMMAND ${git} status --porcelain --untracked-files=no ${counted}
      OUTPUT_VARIABLE changes RESULT_VARIABLE failed ERROR_QUIET)
    if(failed OR NOT changes STREQUAL "")
      string(APPEND COMMIT -dirty)
    endif()
  endif()
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
string(REPLACE " " "\\ " needs "${needs}")
string(REPLACE "\n" " \\\n  " needs "${needs}")
file(WRITE ${DEPFILE} "${OUTPUT}: ${needs}\n")
