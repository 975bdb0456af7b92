# Defines the packages of cpack -G DEB: bdpt (the command, the libraries, man pages, completions, documents),
# bdpt-openimageio (the module that reads TIFF images), bdpt-openvdb (the program that reads volumes), libbdpt-dev
# (headers, CMake and pkg-config files) and, if the Python package is built with Debian's Python, python3-bdpt.
if(NOT BUILD_SHARED_LIBS OR NOT BDPT_BUILD_APPS)
  return()
endif()
# The builder of a package is its maintainer, as in the variables of Debian's own tools. The default address cannot
# exist (RFC 2606).
set(contact "bdpt <nobody@bdpt.invalid>")
if(DEFINED ENV{DEBEMAIL})
  set(contact "bdpt <$ENV{DEBEMAIL}>")
  if(DEFINED ENV{DEBFULLNAME})
    set(contact "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
  endif()
endif()
set(BDPT_PACKAGE_CONTACT "${contact}" CACHE STRING "Maintainer of Debian packages")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME bdpt)
set(CPACK_PACKAGE_CONTACT "${BDPT_PACKAGE_CONTACT}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # otherwise it would come before each package's own first line
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL bdpt_runtime bdpt_development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/DebianFiles.cmake")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_BDPT_RUNTIME_PACKAGE_NAME bdpt)
set(CPACK_DEBIAN_BDPT_RUNTIME_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_BDPT_RUNTIME_DESCRIPTION
"renderer for glTF scenes by bidirectional path tracing
The command bdpt renders glTF 2.0 scenes to OpenEXR and PNG images, alone or
on a farm, and compares integrators. Its libraries do the same for programs.")
# dpkg-shlibdeps finds the packages of the libraries that ours are linked to.
set(CPACK_DEBIAN_BDPT_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_BDPT_RUNTIME_PACKAGE_SUGGESTS "bdpt-openimageio, bdpt-openvdb")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
    "${CMAKE_BINARY_DIR}/lib;${CMAKE_BINARY_DIR}/lib/io;${CMAKE_BINARY_DIR}/lib/eval;${CMAKE_BINARY_DIR}/lib/job")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_BDPT_RUNTIME_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/debian/triggers")

if(BDPT_HAS_OPENIMAGEIO)
  list(APPEND CPACK_COMPONENTS_ALL bdpt_openimageio)
  set(CPACK_DEBIAN_BDPT_OPENIMAGEIO_PACKAGE_NAME bdpt-openimageio)
  set(CPACK_DEBIAN_BDPT_OPENIMAGEIO_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_BDPT_OPENIMAGEIO_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_BDPT_OPENIMAGEIO_PACKAGE_DEPENDS "bdpt (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_BDPT_OPENIMAGEIO_DESCRIPTION
"TIFF environments for the renderer bdpt
The module by which bdpt reads TIFF images as environments. OpenEXR and
Radiance HDR images are read without it.")
endif()

if(BDPT_HAS_OPENVDB)
  list(APPEND CPACK_COMPONENTS_ALL bdpt_openvdb)
  set(CPACK_DEBIAN_BDPT_OPENVDB_PACKAGE_NAME bdpt-openvdb)
  set(CPACK_DEBIAN_BDPT_OPENVDB_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_BDPT_OPENVDB_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_BDPT_OPENVDB_PACKAGE_DEPENDS "bdpt (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_BDPT_OPENVDB_DESCRIPTION
"OpenVDB volumes for the renderer bdpt
The program by which bdpt reads OpenVDB files, as smoke and clouds, in a
process of its own.")
endif()

set(CPACK_DEBIAN_BDPT_DEVELOPMENT_PACKAGE_NAME libbdpt-dev)
set(CPACK_DEBIAN_BDPT_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_BDPT_DEVELOPMENT_PACKAGE_DEPENDS "bdpt (= ${PROJECT_VERSION}), libglm-dev")
set(CPACK_DEBIAN_BDPT_DEVELOPMENT_DESCRIPTION
"bidirectional path tracing for programs
Headers of the libraries bdpt, bdpt_io, bdpt_eval and bdpt_job, and their
packages for CMake and pkg-config.")

if(BDPT_BUILD_PYTHON AND BDPT_PYTHON_DEBIAN_DEPENDS)
  list(APPEND CPACK_COMPONENTS_ALL bdpt_python)
  set(CPACK_DEBIAN_BDPT_PYTHON_PACKAGE_NAME python3-bdpt)
  set(CPACK_DEBIAN_BDPT_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_BDPT_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_BDPT_PYTHON_PACKAGE_DEPENDS "bdpt (= ${PROJECT_VERSION}), ${BDPT_PYTHON_DEBIAN_DEPENDS}")
  set(CPACK_DEBIAN_BDPT_PYTHON_PACKAGE_CONTROL_EXTRA
      "${PROJECT_SOURCE_DIR}/cmake/python/postinst;${PROJECT_SOURCE_DIR}/cmake/python/prerm")
  set(CPACK_DEBIAN_BDPT_PYTHON_DESCRIPTION
"bidirectional path tracing for Python
The Python package bdpt renders glTF scenes, or scenes of NumPy arrays, to
NumPy arrays and image files, with the options and the bits of the command.")
endif()
include(CPack)
