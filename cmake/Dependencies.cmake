# Finds each third-party library once. Minimum versions are those of Debian 12.
find_package(Threads REQUIRED)

find_package(glm CONFIG REQUIRED)

# Requests no version of Embree, because its version file accepts only its own major version: both 3.13 and 4.x work
# (lib/src/geometry/embree.h hides the difference).
find_package(embree CONFIG REQUIRED)
if(NOT EMBREE_VERSION_MAJOR)
  string(REGEX MATCH "^[0-9]+" EMBREE_VERSION_MAJOR "${embree_VERSION}")
endif()
if(NOT EMBREE_VERSION_MAJOR MATCHES "^[34]$")
  message(FATAL_ERROR "bdpt needs Embree 3.13 or 4, but found ${embree_VERSION}")
endif()

find_package(TBB CONFIG REQUIRED)

# Uses only the header of xxHash, from 0.8 on: it is compiled in.
find_path(BDPT_XXHASH_INCLUDE_DIR xxhash.h REQUIRED)

set(BDPT_HAS_DRACO OFF)
set(BDPT_HAS_MESHOPT OFF)
set(BDPT_HAS_OPENIMAGEIO OFF)
set(BDPT_HAS_OPENVDB OFF)
set(BDPT_HAS_SECCOMP OFF)
if(BDPT_BUILD_IO)
  find_package(OpenEXR CONFIG REQUIRED)
  find_package(Imath CONFIG REQUIRED)
  find_package(JPEG REQUIRED)  # libjpeg-turbo or a library with the same interface
  list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
  find_package(WebP REQUIRED MODULE)  # FindWebP.cmake
  find_package(nlohmann_json CONFIG REQUIRED)
  find_package(fmt CONFIG REQUIRED)

  # Uses only the structs of tinygltf.
  find_path(BDPT_TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)

  # Looks for decoders of compressed meshes; without them bdpt refuses such files with an error that names the decoder.
  if(BDPT_WITH_DRACO)
    find_package(draco CONFIG QUIET)
    if(TARGET draco::draco)
      set(BDPT_HAS_DRACO ON)
    endif()
  endif()
  if(BDPT_WITH_MESHOPT)
    find_package(meshoptimizer CONFIG QUIET)
    if(TARGET meshoptimizer::meshoptimizer)
      set(BDPT_HAS_MESHOPT ON)
    endif()
  endif()
  message(STATUS "Compressed meshes: Draco ${BDPT_HAS_DRACO}, meshoptimizer ${BDPT_HAS_MESHOPT}")

  # Looks for the reader of volumes; without it bdpt refuses such files with an error that names it. Tries to compile a
  # program with its headers, which need Boost headers that OpenVDB packages do not depend on.
  if(BDPT_WITH_OPENVDB)
    find_path(BDPT_OPENVDB_INCLUDE_DIR openvdb/openvdb.h)
    find_library(BDPT_OPENVDB_LIBRARY openvdb)
    if(BDPT_OPENVDB_INCLUDE_DIR AND BDPT_OPENVDB_LIBRARY)
      add_library(bdpt_openvdb INTERFACE IMPORTED)
      target_include_directories(bdpt_openvdb SYSTEM INTERFACE "${BDPT_OPENVDB_INCLUDE_DIR}")
      target_link_libraries(bdpt_openvdb INTERFACE "${BDPT_OPENVDB_LIBRARY}" TBB::tbb Imath::Imath)
      # Its templates define variables that must be shared with the library.
      target_compile_options(bdpt_openvdb INTERFACE -fvisibility=default -fno-visibility-inlines-hidden)
      if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 16)
        # Boost 1.74 casts -1 to an enumeration.
        target_compile_options(bdpt_openvdb INTERFACE -Wno-enum-constexpr-conversion)
      endif()
      include(CheckCXXSourceCompiles)
      set(CMAKE_REQUIRED_LIBRARIES bdpt_openvdb)
      set(CMAKE_REQUIRED_FLAGS "-std=c++20")
      check_cxx_source_compiles("
        #include <openvdb/openvdb.h>
        int main() { openvdb::initialize(); }" BDPT_OPENVDB_COMPILES)
      unset(CMAKE_REQUIRED_LIBRARIES)
      unset(CMAKE_REQUIRED_FLAGS)
      if(BDPT_OPENVDB_COMPILES)
        set(BDPT_HAS_OPENVDB ON)
      else()
        message(STATUS "OpenVDB is here, but does not compile: are there headers of Boost (libboost-dev)?")
        unset(BDPT_OPENVDB_COMPILES CACHE)  # OpenVDB may be complete at the next configuration
      endif()
    endif()
  endif()
  message(STATUS "Volumes: OpenVDB ${BDPT_HAS_OPENVDB}")

  # Looks for what confines the programs that read files with OpenVDB and libktx; without it they are limited only in
  # memory and time.
  if(BDPT_WITH_SECCOMP)
    find_path(BDPT_SECCOMP_INCLUDE_DIR seccomp.h)
    find_library(BDPT_SECCOMP_LIBRARY seccomp)
    if(BDPT_SECCOMP_INCLUDE_DIR AND BDPT_SECCOMP_LIBRARY)
      set(BDPT_HAS_SECCOMP ON)
    endif()
  endif()
  message(STATUS "Confined readers of files: libseccomp ${BDPT_HAS_SECCOMP}")

  # Looks for the reader of TIFF images; without it bdpt refuses such files with an error that names it.
  if(BDPT_WITH_OPENIMAGEIO)
    find_package(OpenImageIO CONFIG QUIET)
    set(BDPT_HAS_OPENIMAGEIO ${OpenImageIO_FOUND})
  endif()
  if(BDPT_HAS_OPENIMAGEIO)
    # Removes include directories that Debian's package exports but does not install.
    foreach(target OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
      get_target_property(directories ${target} INTERFACE_INCLUDE_DIRECTORIES)
      set(existing "")
      foreach(directory IN LISTS directories)
        if(EXISTS "${directory}")
          list(APPEND existing "${directory}")
        endif()
      endforeach()
      set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${existing}")
    endforeach()
  endif()
  message(STATUS "TIFF images: OpenImageIO ${BDPT_HAS_OPENIMAGEIO}")
endif()

if(BDPT_BUILD_APPS)
  find_package(CLI11 CONFIG REQUIRED)
  find_package(Boost 1.74 REQUIRED)  # Beast headers for the server of bdpt view
endif()

if(BDPT_BUILD_TESTS)
  find_package(Catch2 CONFIG REQUIRED)  # 2.13 or 3.x: tests/support/catch.hpp
  find_package(Python3 COMPONENTS Interpreter REQUIRED)
  include(Catch)
endif()
