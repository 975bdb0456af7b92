# Embeds the page of bdpt view in a C++ file, as arrays:
# cmake -DOUTPUT=FILE.cpp -DSTYLES=a.css;... -DSCRIPTS=a.js;... -DTEMPLATE=view.html -P embed.cmake
include("${CMAKE_CURRENT_LIST_DIR}/../../../cmake/EmbedText.cmake")

string(REPLACE "\\;" ";" STYLES "${STYLES}")
string(REPLACE "\\;" ";" SCRIPTS "${SCRIPTS}")
file(WRITE "${OUTPUT}.tmp" "#include \"view/server/page.h\"\n\nnamespace bdpt::app {\n\n")
bdpt_embed_text("${OUTPUT}.tmp" page_template "${TEMPLATE}")
bdpt_embed_text("${OUTPUT}.tmp" page_style ${STYLES})
bdpt_embed_text("${OUTPUT}.tmp" page_script ${SCRIPTS})
file(APPEND "${OUTPUT}.tmp" "}  // namespace bdpt::app\n")
file(RENAME "${OUTPUT}.tmp" "${OUTPUT}")
