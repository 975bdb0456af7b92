# Third-party libraries, each found once. Versions as in Debian 12 and newer.
find_package(Threads REQUIRED)

find_package(glm CONFIG REQUIRED)

# The version file of Embree accepts its own major version only, so none is asked for: 3.13 and 4.x
# both serve (lib/src/geometry/embree.h hides the difference).
find_package(embree CONFIG REQUIRED)
if(NOT EMBREE_VERSION_MAJOR)
  string(REGEX MATCH "^[0-9]+" EMBREE_VERSION_MAJOR "${embree_VERSION}")
endif()
if(NOT EMBREE_VERSION_MAJOR MATCHES "^[34]$")
  message(FATAL_ERROR "bdpt needs Embree 3.13 or 4, but found ${embree_VERSION}")
endif()

find_package(TBB CONFIG REQUIRED)

# The header of xxHash alone, from 0.8 on: it is compiled in.
find_path(BDPT_XXHASH_INCLUDE_DIR xxhash.h REQUIRED)

set(BDPT_HAS_DRACO OFF)
set(BDPT_HAS_MESHOPT OFF)
if(BDPT_BUILD_IO)
  find_package(OpenEXR CONFIG REQUIRED)
  find_package(Imath CONFIG REQUIRED)
  find_package(JPEG REQUIRED)  # of libjpeg-turbo or another one with its interface
  list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
  find_package(WebP REQUIRED MODULE)  # FindWebP.cmake
  find_package(nlohmann_json CONFIG REQUIRED)
  find_package(fmt CONFIG REQUIRED)

  # Only the header of tinygltf is used, with the system's JSON library and without its image code.
  find_path(BDPT_TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)

  # Decoders of compressed meshes: without them such files are refused by name.
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

  find_package(OpenImageIO CONFIG REQUIRED)
  # Debian's package exports include directories that its dependencies do not install.
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

if(BDPT_BUILD_APPS)
  find_package(CLI11 CONFIG REQUIRED)
endif()

if(BDPT_BUILD_TESTS)
  find_package(Catch2 CONFIG REQUIRED)  # 2.13 or 3.x: tests/support/catch.hpp
  find_package(Python3 COMPONENTS Interpreter REQUIRED)
  include(Catch)
endif()

if(BDPT_BUILD_BENCHMARKS)
  find_package(benchmark CONFIG REQUIRED)
endif()
