# CPack runs this over the files that it gathered, because other machines do not have this machine's library folders.
file(GLOB_RECURSE gathered ${CPACK_TEMPORARY_DIRECTORY}/*)
foreach(file IN LISTS gathered)
  if(NOT IS_SYMLINK ${file} AND (file MATCHES "\\.so[.0-9a-z_-]*$" OR file MATCHES "/bin/[^/]+$"))
    file(RPATH_REMOVE FILE ${file})
  endif()
endforeach()
