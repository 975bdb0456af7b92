# Applies the sanitizers to everything in this build.
set(bdpt_sanitizers ${BDPT_SANITIZE})

# Checks for libFuzzer; without it tests/fuzz prints a message and replays seeds instead.
set(BDPT_HAS_LIBFUZZER OFF)
if(BDPT_BUILD_FUZZERS)
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_FLAGS "-fsanitize=fuzzer")
  check_cxx_source_compiles("
    #include <cstddef>
    #include <cstdint>
    extern \"C\" int LLVMFuzzerTestOneInput(const std::uint8_t*, std::size_t) { return 0; }"
    BDPT_LIBFUZZER_LINKS)
  unset(CMAKE_REQUIRED_FLAGS)
  set(BDPT_HAS_LIBFUZZER ${BDPT_LIBFUZZER_LINKS})
endif()
if(BDPT_HAS_LIBFUZZER)
  list(APPEND bdpt_sanitizers fuzzer-no-link)
endif()

if(bdpt_sanitizers)
  list(JOIN bdpt_sanitizers "," bdpt_sanitizers)
  add_compile_options(-fsanitize=${bdpt_sanitizers} -fno-omit-frame-pointer
                      -fno-sanitize-recover=all)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # Functions of libktx are called through types of our own declarations.
    add_compile_options(-fno-sanitize=function)
  endif()
  add_link_options(-fsanitize=${bdpt_sanitizers})
endif()
