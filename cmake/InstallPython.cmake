# Installs the Python package, for pip (SKBUILD, which sets the folder) and for cmake --install; records the
# dependencies of its Debian package.
execute_process(COMMAND "${Python_EXECUTABLE}" -c
  "import sys; print('%d;%d;%s' % (*sys.version_info[:2], sys.base_prefix))"
  OUTPUT_STRIP_TRAILING_WHITESPACE OUTPUT_VARIABLE python COMMAND_ERROR_IS_FATAL ANY)
list(GET python 0 major)
list(GET python 1 minor)
list(GET python 2 python_prefix)

# Detects Debian's own Python, also in a virtual environment. Its package works with one minor version of Python only.
set(BDPT_PYTHON_DEBIAN_DEPENDS "")
if(python_prefix STREQUAL "/usr" AND EXISTS "/etc/debian_version")
  math(EXPR next "${minor} + 1")
  set(BDPT_PYTHON_DEBIAN_DEPENDS
      "python3 (>= ${major}.${minor}), python3 (<< ${major}.${next}), python3-numpy")
endif()

set(installer cmake)
if(DEFINED SKBUILD)
  set(default_folder .)
elseif(BDPT_PYTHON_DEBIAN_DEPENDS)
  set(default_folder "lib/python3/dist-packages")
  set(installer debian)
else()
  set(default_folder "lib/python${major}.${minor}/site-packages")
endif()
set(BDPT_PYTHON_INSTALL_DIR "${default_folder}" CACHE STRING "Where the Python package is installed")

set(package "${BDPT_PYTHON_PATH}/bdpt")
install(TARGETS bdpt_python LIBRARY DESTINATION "${BDPT_PYTHON_INSTALL_DIR}/bdpt" COMPONENT bdpt_python)
install(FILES "${package}/__init__.py" "${package}/_dataset.py" "${package}/_signatures.py" "${package}/_trimesh.py" "${package}/py.typed" "${package}/_bdpt.pyi"
        DESTINATION "${BDPT_PYTHON_INSTALL_DIR}/bdpt" COMPONENT bdpt_python)
if(DEFINED SKBUILD)
  # A wheel contains bdpt_io twice, in its module and in its program; both find companions beside themselves.
  install(TARGETS bdpt_app RUNTIME DESTINATION "${BDPT_PYTHON_INSTALL_DIR}/bdpt" COMPONENT bdpt_python)
  install(FILES apps/python/package/__main__.py
          DESTINATION "${BDPT_PYTHON_INSTALL_DIR}/bdpt" COMPONENT bdpt_python)
  if(BDPT_HAS_OPENIMAGEIO)
    install(TARGETS bdpt_oiio LIBRARY DESTINATION "${BDPT_PYTHON_INSTALL_DIR}/bdpt" COMPONENT bdpt_python_companions)
  endif()
  install(TARGETS bdpt_ktx_reader RUNTIME DESTINATION "${BDPT_PYTHON_INSTALL_DIR}/bdpt"
          COMPONENT bdpt_python_companions)
  if(BDPT_KTX)
    install(DIRECTORY "${BDPT_KTX}/" DESTINATION "${BDPT_PYTHON_INSTALL_DIR}/bdpt/ktx"
            COMPONENT bdpt_python_companions)
  endif()
  if(BDPT_HAS_OPENVDB)
    install(TARGETS bdpt_vdb_reader RUNTIME DESTINATION "${BDPT_PYTHON_INSTALL_DIR}/bdpt"
            COMPONENT bdpt_python_companions)
  endif()
  return()  # pip does the rest
endif()

file(RELATIVE_PATH to_libdir "${CMAKE_INSTALL_PREFIX}/${BDPT_PYTHON_INSTALL_DIR}/bdpt"
     "${CMAKE_INSTALL_FULL_LIBDIR}")
set_property(TARGET bdpt_python APPEND PROPERTY INSTALL_RPATH "$ORIGIN/${to_libdir}")

# Writes the metadata by which pip recognises the package and its installer.
set(information "${PROJECT_BINARY_DIR}/cmake/bdpt-${PROJECT_VERSION}.dist-info")
file(STRINGS "${PROJECT_SOURCE_DIR}/pyproject.toml" project REGEX "^(description|requires-python) = ")
foreach(line IN LISTS project)
  string(REGEX MATCH "^([a-z-]+) = \"(.*)\"" matched "${line}")
  set(python_${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
endforeach()
configure_file(cmake/python/METADATA.in "${information}/METADATA" @ONLY)
file(WRITE "${information}/INSTALLER" "${installer}\n")
install(DIRECTORY "${information}" DESTINATION "${BDPT_PYTHON_INSTALL_DIR}" COMPONENT bdpt_python)
install(FILES LICENSE DESTINATION "${BDPT_PYTHON_INSTALL_DIR}/bdpt-${PROJECT_VERSION}.dist-info"
        COMPONENT bdpt_python)
install(FILES LICENSE RENAME copyright DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/python3-bdpt"
        COMPONENT bdpt_python)
