# Compiles for Linux on aarch64 by clang++ 19 and lld 19. BDPT_SYSROOT is a folder with the libraries and headers of a
# Debian for arm64 (cmake/dist/roots.sh makes one); programs of the build, as that of the man pages, run under
# qemu-aarch64.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(BDPT_SYSROOT "" CACHE PATH "The root of a Debian for arm64")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES BDPT_SYSROOT)
if(NOT BDPT_SYSROOT)
  message(FATAL_ERROR "-DBDPT_SYSROOT=FOLDER must name the root of a Debian for arm64")
endif()

set(CMAKE_SYSROOT "${BDPT_SYSROOT}")
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
foreach(language IN ITEMS C CXX)
  set(CMAKE_${language}_COMPILER_TARGET aarch64-linux-gnu)
endforeach()
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_CXX_COMPILER clang++-19)
foreach(kind IN ITEMS EXE SHARED MODULE)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT "-fuse-ld=lld-19")
endforeach()
find_program(BDPT_QEMU NAMES qemu-aarch64 qemu-aarch64-static REQUIRED)
set(CMAKE_CROSSCOMPILING_EMULATOR "${BDPT_QEMU};-L;${BDPT_SYSROOT}")

set(CMAKE_FIND_ROOT_PATH "${BDPT_SYSROOT}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind IN ITEMS LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
