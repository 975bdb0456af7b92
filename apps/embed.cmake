# Embeds files in a C++ file, as functions that return their text; several files become one text:
# cmake -DOUTPUT=FILE.cpp -DHEADER=view/server/page.h -DNAMESPACE=bdpt::app "-DTEXTS=NAME=FILE,FILE;NAME=FILE" -P embed.cmake
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/EmbedText.cmake")

file(WRITE "${OUTPUT}.tmp" "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\n")
string(REPLACE "\\;" ";" TEXTS "${TEXTS}")
foreach(text IN LISTS TEXTS)
  string(FIND "${text}" "=" at)
  string(SUBSTRING "${text}" 0 ${at} name)
  math(EXPR at "${at} + 1")
  string(SUBSTRING "${text}" ${at} -1 files)
  string(REPLACE "," ";" files "${files}")
  bdpt_embed_text("${OUTPUT}.tmp" ${name} ${files})
endforeach()
file(APPEND "${OUTPUT}.tmp" "}  // namespace ${NAMESPACE}\n")
file(RENAME "${OUTPUT}.tmp" "${OUTPUT}")
