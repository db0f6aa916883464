# run(EXIT_CODE PATTERN COMMAND…) runs the command in the folder WORK; its output must match.
function(run expected pattern)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("$ ${ARGN}\n${output}")
  if(NOT code STREQUAL expected OR NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "exit code ${code}, expected ${expected} and output that matches ${pattern}")
  endif()
endfunction()
