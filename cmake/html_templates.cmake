# Makes the folder's templates of HTML constants of the target: name.html is the std::string_view name_html in the
# namespace. A line break before an indented tag is layout and left out, and so is the last one; other line breaks are
# the page's. CMake must run again for a new template.
find_path(URSULA_MUSTACHE kainjow/mustache.hpp REQUIRED)  # Debian's libkainjow-mustache-dev
mark_as_advanced(URSULA_MUSTACHE)

function(ursula_html_templates target namespace)
  file(GLOB files *.html web/*.html)
  set(constants "")
  foreach(file IN LISTS files)
    file(READ ${file} html)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    string(REGEX REPLACE "\n +([<{])" "\\1" html "${html}")
    string(REGEX REPLACE "\n$" "" html "${html}")
    cmake_path(GET file STEM LAST_ONLY name)
    string(APPEND constants "extern const std::string_view ${name}_html = R\"ursula(${html})ursula\";\n")
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/html_templates.cpp)
  file(CONFIGURE OUTPUT ${source}
    CONTENT "#include <string_view>\n\nnamespace ${namespace} {\n\n${constants}\n}  // namespace ${namespace}\n" @ONLY)
  target_sources(${target} PRIVATE ${source})
endfunction()
