# Run by cpack -G DEB: below /usr, zsh of Debian looks for completions of packages in another folder than elsewhere.
file(GLOB folders "${CPACK_TEMPORARY_DIRECTORY}/*/usr/share/zsh/site-functions")
foreach(folder IN LISTS folders)
  cmake_path(REPLACE_FILENAME folder vendor-completions OUTPUT_VARIABLE debian_folder)
  file(RENAME "${folder}" "${debian_folder}")
endforeach()
