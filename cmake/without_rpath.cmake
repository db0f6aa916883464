# CPack runs this over the files that it gathered, because other machines do not have this machine's library folders. The
# reference LAPACK's, which are Debian's, stay with what needs them.
file(GLOB_RECURSE gathered ${CPACK_TEMPORARY_DIRECTORY}/*)
foreach(file IN LISTS gathered)
  if(NOT IS_SYMLINK ${file} AND (file MATCHES "\\.so[.0-9a-z_-]*$" OR file MATCHES "/bin/[^/]+$"))
    file(STRINGS ${file} its_rpath REGEX "/lapack:/" LIMIT_COUNT 1)
    if(CPACK_URSULA_RPATH AND its_rpath)
      file(RPATH_SET FILE ${file} NEW_RPATH "${CPACK_URSULA_RPATH}")
    else()
      file(RPATH_REMOVE FILE ${file})
    endif()
  endif()
endforeach()
