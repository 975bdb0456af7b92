# Packages for pkg-config: bdpt, bdpt_io and bdpt_harness. With static libraries ask with --static.
file(RELATIVE_PATH pc_to_prefix "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
file(RELATIVE_PATH pc_libdir "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_LIBDIR}")
file(RELATIVE_PATH pc_includedir "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")

# Not every GLM has a pkg-config file.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(BDPT_PC_GLM QUIET glm)
endif()
set(pc_requires "")
set(pc_cflags "")
if(BDPT_PC_GLM_FOUND)
  set(pc_requires "glm")
else()
  get_target_property(directories glm::glm INTERFACE_INCLUDE_DIRECTORIES)
  list(REMOVE_ITEM directories ${CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES})
  list(TRANSFORM directories PREPEND " -I")
  string(JOIN "" pc_cflags ${directories})
endif()

# What a static library is made with. pkg-config looks for it at every call, so a shared one names
# nothing.
set(pc_core_requires "")
set(pc_core_libs "")
set(pc_io_requires "")
set(pc_harness_requires "")
set(pc_io_libs "")
if(NOT BUILD_SHARED_LIBS)
  set(pc_core_requires "tbb")
  set(pc_core_libs "-lembree${EMBREE_VERSION_MAJOR} -pthread")
  set(pc_io_requires "OpenEXR, Imath, libpng, fmt")
  set(pc_harness_requires "tbb, zlib")
  set(pc_io_libs "${CMAKE_DL_LIBS}")
  if(pc_io_libs)
    string(PREPEND pc_io_libs "-l")
  endif()
endif()

configure_file(cmake/bdpt.pc.in cmake/bdpt.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/cmake/bdpt.pc"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT bdpt_development)
if(BDPT_BUILD_IO)
  configure_file(cmake/bdpt_io.pc.in cmake/bdpt_io.pc @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/cmake/bdpt_io.pc"
          DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT bdpt_development)
endif()
if(BDPT_BUILD_HARNESS)
  configure_file(cmake/bdpt_harness.pc.in cmake/bdpt_harness.pc @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/cmake/bdpt_harness.pc"
          DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT bdpt_development)
endif()
