# bdpt_compile_options(TARGET): the language level, the warnings, the arithmetic and the visibility
# that all our code is built with.
function(bdpt_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Shared libraries export what is marked BDPT_EXPORT and nothing else.
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF
                        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  set(shadow -Wshadow)
  if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Of many files that are compiled as one, none is the main file, and each sees the functions of others.
    set(shadow -Wshadow=local -Wno-subobject-linkage)
  endif()
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic ${shadow} -Wconversion -Wsign-conversion -Wnon-virtual-dtor
    -Wold-style-cast -Woverloaded-virtual -Wimplicit-fallthrough
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # false alarms of g++ 12 on std::string
    # A product and a sum are rounded apart on every CPU, so that images are equal to the bit.
    -ffp-contract=off
    # No errno and no trapping: sqrt and comparisons become single instructions. Values stay IEEE.
    -fno-math-errno -fno-trapping-math
    # What is installed names no folder of the build, as messages of failed assertions would.
    -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=
    # Nobody replaces our functions at load time, so exported ones may be inlined too.
    -fno-semantic-interposition)
  if(BDPT_WERROR)
    target_compile_options(${target} PRIVATE -Werror
      # What g++ finds in inlined code of the standard library is another false alarm in each version.
      $<$<CXX_COMPILER_ID:GNU>:-Wno-error=array-bounds -Wno-error=stringop-overflow -Wno-error=stringop-overread>)
  endif()
endfunction()
