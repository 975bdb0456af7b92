# Installs libraries, headers, the command, and the files by which CMake and pkg-config find them. The installation is
# relocatable: all paths in it are relative.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/bdpt")
set(libraries bdpt)
if(BDPT_BUILD_IO)
  list(APPEND libraries bdpt_io)
endif()
if(BDPT_BUILD_EVAL)
  list(APPEND libraries bdpt_eval)
endif()
if(BDPT_BUILD_APPS)
  list(APPEND libraries bdpt_job)
endif()

# Sources that compile with 1.0 compile with each later 1.x, but structs grow: each minor version has its own ABI.
set_target_properties(${libraries} PROPERTIES VERSION ${PROJECT_VERSION}
                      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

# bdpt_install_library(TARGET EXPORT_NAME EXPORT): installs a library and adds it to the CMake package.
function(bdpt_install_library target export_name export)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name})
  install(TARGETS ${target} EXPORT ${export}
    RUNTIME COMPONENT bdpt_runtime
    LIBRARY COMPONENT bdpt_runtime NAMELINK_COMPONENT bdpt_development
    ARCHIVE COMPONENT bdpt_development
    INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  install(EXPORT ${export} NAMESPACE bdpt:: DESTINATION "${package_dir}"
          COMPONENT bdpt_development)
endfunction()

bdpt_install_library(bdpt bdpt bdptCoreTargets)
install(DIRECTORY lib/include/ "${PROJECT_BINARY_DIR}/lib/include/"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT bdpt_development
        FILES_MATCHING PATTERN "*.h")

if(BDPT_BUILD_IO)
  bdpt_install_library(bdpt_io io bdptIoTargets)
  set_property(TARGET bdpt_io APPEND PROPERTY INSTALL_RPATH "$ORIGIN")
  install(DIRECTORY lib/io/include/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
          COMPONENT bdpt_development FILES_MATCHING PATTERN "*.h")
  # Installs the companions where bdpt_io looks for them (lib/io/src/file/read_file.cpp). The TIFF module is a component
  # of its own, because it depends on OpenImageIO and its 260 libraries, and everything else works without it. So is the
  # reader of volumes.
  if(BDPT_HAS_OPENIMAGEIO)
    install(TARGETS bdpt_oiio LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/bdpt"
            COMPONENT bdpt_openimageio)
  endif()
  # The KTX reader links no library; it opens libktx at run time.
  if(BDPT_KTX)
    install(DIRECTORY "${BDPT_KTX}/" DESTINATION "${CMAKE_INSTALL_LIBDIR}/bdpt/ktx" COMPONENT bdpt_ktx)
  endif()
  install(TARGETS bdpt_ktx_reader RUNTIME DESTINATION "${CMAKE_INSTALL_LIBDIR}/bdpt"
          COMPONENT bdpt_runtime)
  if(BDPT_DENOISER)
    install(DIRECTORY "${BDPT_DENOISER}/" DESTINATION "${CMAKE_INSTALL_LIBDIR}/bdpt/denoiser"
            COMPONENT bdpt_denoiser)
  endif()
  if(BDPT_HAS_OPENVDB)
    install(TARGETS bdpt_vdb_reader RUNTIME DESTINATION "${CMAKE_INSTALL_LIBDIR}/bdpt"
            COMPONENT bdpt_openvdb)
  endif()
endif()

if(BDPT_BUILD_EVAL)
  bdpt_install_library(bdpt_eval eval bdptEvalTargets)
  set_property(TARGET bdpt_eval APPEND PROPERTY INSTALL_RPATH "$ORIGIN")
  install(DIRECTORY lib/eval/include/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
          COMPONENT bdpt_development FILES_MATCHING PATTERN "*.h")
endif()

if(BDPT_BUILD_APPS)
  bdpt_install_library(bdpt_job job bdptJobTargets)
  set_property(TARGET bdpt_job APPEND PROPERTY INSTALL_RPATH "$ORIGIN")
  install(DIRECTORY lib/job/include/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
          COMPONENT bdpt_development FILES_MATCHING PATTERN "*.h")
  file(RELATIVE_PATH to_libdir "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
  set_property(TARGET bdpt_app APPEND PROPERTY INSTALL_RPATH "$ORIGIN/${to_libdir}")
  install(TARGETS bdpt_app RUNTIME COMPONENT bdpt_runtime)
  install(DIRECTORY "${BDPT_MANUAL_DIR}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}"
          COMPONENT bdpt_runtime)
  install(FILES apps/desktop/bdpt.thumbnailer DESTINATION "${CMAKE_INSTALL_DATADIR}/thumbnailers"
          COMPONENT bdpt_runtime)
  set(engines lib/job/src/plan/engines)
  install(PROGRAMS ${engines}/submit.sh ${engines}/tasks.sbatch ${engines}/merge.sbatch
          DESTINATION "${CMAKE_INSTALL_DATADIR}/bdpt/engines" COMPONENT bdpt_runtime)
  install(FILES ${engines}/kubernetes.yaml ${engines}/Makefile
          DESTINATION "${CMAKE_INSTALL_DATADIR}/bdpt/engines" COMPONENT bdpt_runtime)
  install(FILES "${BDPT_MANUAL_DIR}/bash/bdpt" COMPONENT bdpt_runtime
          DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
  install(FILES "${BDPT_MANUAL_DIR}/zsh/_bdpt" COMPONENT bdpt_runtime
          DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
  install(FILES "${BDPT_MANUAL_DIR}/fish/bdpt.fish" COMPONENT bdpt_runtime
          DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
endif()

configure_package_config_file(cmake/bdptConfig.cmake.in cmake/bdptConfig.cmake
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/cmake/bdptConfigVersion.cmake"
  COMPATIBILITY SameMajorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/cmake/bdptConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/cmake/bdptConfigVersion.cmake"
        DESTINATION "${package_dir}" COMPONENT bdpt_development)

if(BDPT_BUILD_IO AND NOT BUILD_SHARED_LIBS)
  install(FILES cmake/FindWebP.cmake DESTINATION "${package_dir}" COMPONENT bdpt_development)
endif()

include(cmake/PkgConfig.cmake)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}"
        COMPONENT bdpt_runtime)
install(FILES LICENSE RENAME copyright DESTINATION "${CMAKE_INSTALL_DOCDIR}"
        COMPONENT bdpt_runtime)  # where Debian's tools look for it
# Installs the same for each other package.
set(packages bdpt-openimageio bdpt-openvdb libbdpt-dev)
set(components bdpt_openimageio bdpt_openvdb bdpt_development)
foreach(package component IN ZIP_LISTS packages components)
  install(FILES LICENSE RENAME copyright DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}"
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT bdpt_runtime
        FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg")
if(BDPT_BUILD_PYTHON AND BDPT_BUILD_APPS)
  include(cmake/InstallPython.cmake)
endif()
include(cmake/DebianPackages.cmake)
include(cmake/Archive.cmake)
