# Adapts the files below CPACK_TEMPORARY_DIRECTORY to Debian's policy. cpack -G DEB runs it before packing.

# Debian's zsh looks for packaged completions in a folder of its own.
file(GLOB folders "${CPACK_TEMPORARY_DIRECTORY}/*/usr/share/zsh/site-functions")
foreach(folder IN LISTS folders)
  cmake_path(REPLACE_FILENAME folder vendor-completions OUTPUT_VARIABLE debian_folder)
  file(RENAME "${folder}" "${debian_folder}")
endforeach()

# Adds changelog and copyright to each package; Debian systems have the text of the licence already.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # uses SOURCE_DATE_EPOCH if it is set
file(GLOB folders "${CPACK_TEMPORARY_DIRECTORY}/*/usr/share/doc/*")
foreach(folder IN LISTS folders)
  cmake_path(GET folder FILENAME package)
  file(WRITE "${folder}/changelog" "${package} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n"
       "  * Version ${CPACK_PACKAGE_VERSION}: CHANGELOG.md of the package bdpt lists the changes.\n\n"
       " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  file(WRITE "${folder}/copyright" "bdpt, bidirectional path tracing.\n\nCopyright 2026 the authors of bdpt\n\n"
       "License: Apache License, Version 2.0. On Debian systems its text is in\n"
       "/usr/share/common-licenses/Apache-2.0.\n")
  file(REMOVE "${folder}/LICENSE")
endforeach()

file(GLOB licences "${CPACK_TEMPORARY_DIRECTORY}/*/usr/lib/python3/dist-packages/*.dist-info/LICENSE")
if(licences)
  file(REMOVE ${licences})
endif()

file(GLOB files "${CPACK_TEMPORARY_DIRECTORY}/*/usr/share/man/man1/*.1"
     "${CPACK_TEMPORARY_DIRECTORY}/*/usr/share/doc/*/changelog")
if(files)
  execute_process(COMMAND gzip -9 -n ${files} COMMAND_ERROR_IS_FATAL ANY)
endif()

# wanted(COMPONENT PACKAGE TEXT): overrides a finding of lintian that is intended, if the component is packed.
function(wanted component package text)
  if(EXISTS "${CPACK_TEMPORARY_DIRECTORY}/${component}/usr")
    file(APPEND "${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/share/lintian/overrides/${package}" "${text}\n")
  endif()
endfunction()
wanted(bdpt_runtime bdpt
"# The packages of this version use exactly these libraries; they are not kept beside those of another version.
bdpt: package-name-doesnt-match-sonames *")
wanted(bdpt_development libbdpt-dev
"# With -DCMAKE_INSTALL_PREFIX=/usr they are in the folder of the architecture, else in /usr/lib.
libbdpt-dev: pkg-config-unavailable-for-cross-compilation *")
wanted(bdpt_runtime bdpt "# CPack writes these scripts.\nbdpt: maintscript-calls-ldconfig *")
wanted(bdpt_openimageio bdpt-openimageio "# CPack writes these scripts.\nbdpt-openimageio: maintscript-calls-ldconfig *")
