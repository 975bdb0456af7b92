# bdpt_embed(OUTPUT HEADER NAMESPACE NAME=FILE,FILE...): writes OUTPUT, a C++ file with a function NAME() in NAMESPACE for
# each of the further arguments, which returns the concatenated files as a std::string_view. HEADER declares them.
function(bdpt_embed output header namespace)
  string(REPLACE ";" "\\;" texts "${ARGN}")
  string(REGEX REPLACE "[a-z_]+=" "" files "${ARGN}")
  string(REPLACE "," ";" files "${files}")
  add_custom_command(
    OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${output}" "-DHEADER=${header}" "-DNAMESPACE=${namespace}" "-DTEXTS=${texts}"
            -P "${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake"
    DEPENDS "${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake" ${files}
    COMMENT "Embedding texts of ${header}"
    VERBATIM)
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()

# Run by that command.
file(WRITE "${OUTPUT}.tmp" "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\n")
string(REPLACE "\\;" ";" TEXTS "${TEXTS}")
foreach(text IN LISTS TEXTS)
  string(FIND "${text}" "=" at)
  string(SUBSTRING "${text}" 0 ${at} name)
  math(EXPR at "${at} + 1")
  string(SUBSTRING "${text}" ${at} -1 files)
  string(REPLACE "," ";" files "${files}")
  set(digits "")
  foreach(source IN LISTS files)
    file(READ "${source}" part HEX)
    string(APPEND digits "${part}")
  endforeach()
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${digits}")
  string(REPEAT "." 100 line)
  string(REGEX REPLACE "(${line})" "\\1\n" bytes "${bytes}")
  file(APPEND "${OUTPUT}.tmp"
       "std::string_view ${name}()\n{\n"
       "    static constexpr unsigned char bytes[]{\n${bytes}};\n"
       "    return {reinterpret_cast<const char*>(bytes), sizeof bytes};\n}\n\n")
endforeach()
file(APPEND "${OUTPUT}.tmp" "}  // namespace ${NAMESPACE}\n")
file(RENAME "${OUTPUT}.tmp" "${OUTPUT}")
