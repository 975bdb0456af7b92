# Defines the target `docs`, if Doxygen is installed: an API reference from the public headers of the libraries that are
# built. Doxygen warnings are errors. A parent project may have a target of that name, so only top-level builds define
# it.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
find_package(Doxygen 1.9 QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()

set(headers "")
foreach(library IN ITEMS bdpt bdpt_io bdpt_eval bdpt_job)  # those that are built
  if(TARGET ${library})
    get_target_property(folders ${library} INTERFACE_INCLUDE_DIRECTORIES)
    string(REGEX REPLACE "\\$<BUILD_INTERFACE:([^>]*)>" "\\1" folders "${folders}")
    list(APPEND headers ${folders})
  endif()
endforeach()

list(REMOVE_DUPLICATES headers)

set(DOXYGEN_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/docs")
set(DOXYGEN_FILE_PATTERNS *.h *.md)
set(DOXYGEN_EXTRACT_ALL YES)  # the names and types of many members need no comment
set(DOXYGEN_STRIP_FROM_PATH ${headers})
set(DOXYGEN_STRIP_FROM_INC_PATH ${headers})
set(DOXYGEN_PREDEFINED BDPT_EXPORT= BDPT_EXPERIMENTAL=)
set(DOXYGEN_MACRO_EXPANSION YES)
set(DOXYGEN_EXPAND_ONLY_PREDEF YES)
set(DOXYGEN_BUILTIN_STL_SUPPORT YES)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_SORT_MEMBER_DOCS NO)
set(DOXYGEN_GENERATE_LATEX NO)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE "${PROJECT_SOURCE_DIR}/docs/api.md")
doxygen_add_docs(docs ${headers} "${PROJECT_SOURCE_DIR}/docs/api.md"
                 COMMENT "API reference: docs/html/index.html in the build folder")
