# cmake -DOUTPUT=FILE.cpp -DFOLDER=... -DSCRIPTS="a.js;b.js" -P embed.cmake: the files of the report as
# arrays of a C++ file, so that a program needs nothing beside it.
function(embed name)
  set(digits "")
  foreach(source IN LISTS ARGN)
    file(READ "${FOLDER}/${source}" part HEX)
    string(APPEND digits "${part}")
  endforeach()
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${digits}")
  string(REPEAT "." 100 line)
  string(REGEX REPLACE "(${line})" "\\1\n" bytes "${bytes}")
  file(APPEND "${OUTPUT}.tmp"
       "std::string_view ${name}()\n{\n"
       "    static constexpr unsigned char bytes[]{\n${bytes}};\n"
       "    return {reinterpret_cast<const char*>(bytes), sizeof bytes};\n}\n\n")
endfunction()

file(WRITE "${OUTPUT}.tmp" "#include \"report/page_source.h\"\n\nnamespace bdpt::eval {\n\n")
embed(page_template page.html)
embed(page_style base.css page.css)
embed(page_script ${SCRIPTS})
file(APPEND "${OUTPUT}.tmp" "}  // namespace bdpt::eval\n")
file(RENAME "${OUTPUT}.tmp" "${OUTPUT}")
