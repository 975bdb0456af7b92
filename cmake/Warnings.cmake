# bdpt_compile_options(TARGET): sets the language level, the warnings, the floating-point model, the symbol visibility
# and the hardening of all our code.
function(bdpt_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Shared libraries export only symbols that are marked BDPT_EXPORT.
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF
                        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  set(shadow -Wshadow)
  if(CMAKE_UNITY_BUILD)
    # In a unity build no file is the main file, and each sees the functions of others, so two warnings are relaxed.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      set(shadow -Wshadow=local -Wno-subobject-linkage)
    else()
      set(shadow)
    endif()
  endif()
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic ${shadow} -Wconversion -Wsign-conversion -Wnon-virtual-dtor
    -Wold-style-cast -Woverloaded-virtual -Wimplicit-fallthrough
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # false positives of g++ 12 on std::string
    # std::stable_sort of libstdc++ 12 uses a deprecated function.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>
    # Forbids fused multiply-add, so that images are equal to the bit on every CPU.
    -ffp-contract=off
    # Drops errno and trapping, so that sqrt and comparisons become single instructions. Values stay IEEE.
    -fno-math-errno -fno-trapping-math
    # Removes build paths from installed files, for example from assertion messages.
    -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=
    # Allows inlining of exported functions: symbol interposition at load time is not supported.
    -fno-semantic-interposition)
  # Binds all functions at start, so that the table of their addresses is read-only afterwards.
  target_link_options(${target} PRIVATE LINKER:-z,relro,-z,now)
  if(BDPT_WERROR)
    target_compile_options(${target} PRIVATE -Werror
      # Each version of g++ has other false positives in inlined code of the standard library.
      $<$<CXX_COMPILER_ID:GNU>:-Wno-error=array-bounds -Wno-error=stringop-overflow -Wno-error=stringop-overread>)
  endif()
endfunction()

# bdpt_guard_buffers(TARGET): ends the program where a buffer or the stack is overwritten. For code that reads files or
# connections; the core reads none, and its loops are hot.
function(bdpt_guard_buffers target)
  if(NOT BDPT_SANITIZE)
    target_compile_options(${target} PRIVATE -fstack-protector-strong
                           $<$<CONFIG:Release>:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2>)
  endif()
endfunction()
