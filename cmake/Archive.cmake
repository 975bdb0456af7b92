# Defines the target bdpt_archive: bdpt-VERSION-linux-PROCESSOR.tar.xz in the build folder, with the command, its man
# pages and completions, the reader of volumes, Open Image Denoise and libktx if BDPT_DENOISER and BDPT_KTX name them,
# and all libraries that they need except glibc. The archive runs wherever it is unpacked.
if(NOT BUILD_SHARED_LIBS OR NOT BDPT_BUILD_APPS OR BDPT_SANITIZE OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
  return()
endif()
set(BDPT_ARCHIVE_NAME "bdpt-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR}")
# Omits the module that reads TIFF images, because OpenImageIO would add about 260 libraries.
set(archive_components bdpt_runtime)
if(BDPT_HAS_OPENVDB)
  list(APPEND archive_components bdpt_openvdb)
endif()
add_custom_target(bdpt_archive
  COMMAND "${CMAKE_COMMAND}" "-DBUILD=${PROJECT_BINARY_DIR}" "-DCONFIG=$<CONFIG>" "-DNAME=${BDPT_ARCHIVE_NAME}"
          "-DCOMPONENTS=${archive_components}" "-DLIBDIR=${CMAKE_INSTALL_LIBDIR}" "-DFOLDER=${PROJECT_BINARY_DIR}"
          "-DDENOISER=${BDPT_DENOISER}" "-DKTX=${BDPT_KTX}" "-DSYSROOT=${CMAKE_SYSROOT}"
          "-DARCHITECTURE=${CMAKE_LIBRARY_ARCHITECTURE}" "-DOBJDUMP=${CMAKE_OBJDUMP}"
          -P "${PROJECT_SOURCE_DIR}/cmake/archive/make_archive.cmake"
  COMMENT "Packing ${BDPT_ARCHIVE_NAME}.tar.xz" VERBATIM)
add_dependencies(bdpt_archive bdpt_app bdpt_manual_files)
if(BDPT_HAS_OPENVDB)
  add_dependencies(bdpt_archive bdpt_vdb_reader)
endif()
