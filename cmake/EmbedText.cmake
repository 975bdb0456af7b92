# bdpt_embed_text(OUTPUT NAME FILE...): appends a C++ function NAME() to OUTPUT that returns the concatenated files as a
# std::string_view. Scripts that run during the build use it.
function(bdpt_embed_text output name)
  set(digits "")
  foreach(source IN LISTS ARGN)
    file(READ "${source}" part HEX)
    string(APPEND digits "${part}")
  endforeach()
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${digits}")
  string(REPEAT "." 100 line)
  string(REGEX REPLACE "(${line})" "\\1\n" bytes "${bytes}")
  file(APPEND "${output}"
       "std::string_view ${name}()\n{\n"
       "    static constexpr unsigned char bytes[]{\n${bytes}};\n"
       "    return {reinterpret_cast<const char*>(bytes), sizeof bytes};\n}\n\n")
endfunction()
