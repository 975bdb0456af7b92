# Embeds the files of the report in a C++ file, as arrays, so that a program needs no other files:
# cmake -DOUTPUT=FILE.cpp -DFOLDER=... -DSCRIPTS="a.js;b.js" -P embed.cmake
include("${CMAKE_CURRENT_LIST_DIR}/../../cmake/EmbedText.cmake")

string(REPLACE "\\;" ";" SCRIPTS "${SCRIPTS}")
list(TRANSFORM SCRIPTS PREPEND "${FOLDER}/")
file(WRITE "${OUTPUT}.tmp" "#include \"report/page_source.h\"\n\nnamespace bdpt::eval {\n\n")
bdpt_embed_text("${OUTPUT}.tmp" page_template "${FOLDER}/page.html")
bdpt_embed_text("${OUTPUT}.tmp" page_style "${FOLDER}/base.css" "${FOLDER}/page.css")
bdpt_embed_text("${OUTPUT}.tmp" page_script ${SCRIPTS})
file(APPEND "${OUTPUT}.tmp" "}  // namespace bdpt::eval\n")
file(RENAME "${OUTPUT}.tmp" "${OUTPUT}")
