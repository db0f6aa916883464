# CPack runs this over what it has gathered: the folders where this machine has libraries are nobody else's.
file(GLOB_RECURSE gathered ${CPACK_TEMPORARY_DIRECTORY}/*)
foreach(file IN LISTS gathered)
  if(NOT IS_SYMLINK ${file} AND (file MATCHES "\\.so[.0-9a-z_-]*$" OR file MATCHES "/bin/[^/]+$"))
    file(RPATH_REMOVE FILE ${file})
  endif()
endforeach()
