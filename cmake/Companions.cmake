# Companions of bdpt::io are files that it loads or starts only on demand: the module that reads TIFF images, and the
# program that reads volumes. It looks for them next to itself (lib/io/src/file/read_file.cpp).

# Open Image Denoise is such a companion, too, in denoiser/lib.
set(BDPT_DENOISER "" CACHE PATH
    "Folder of which lib/ has libOpenImageDenoise.so.2, which builds, installations and the archive take; empty: none")

# And so is libktx, in ktx.
set(BDPT_KTX "" CACHE PATH
    "Folder with libktx.so, which builds, installations, wheels and the archive take; empty: none")

# bdpt_add_companion(TARGET): builds TARGET with bdpt_io in a separate folder.
function(bdpt_add_companion target)
  bdpt_guard_buffers(${target})
  set_target_properties(${target} PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/companions"
    RUNTIME_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/companions")
  add_dependencies(bdpt_io ${target})
  set_property(GLOBAL APPEND PROPERTY BDPT_COMPANIONS ${target})
endfunction()

# bdpt_put_companions_beside(TARGET): links the companions into the build folder of TARGET, which contains the code of
# bdpt_io: the shared library itself, or a program that links the static one.
function(bdpt_put_companions_beside target)
  get_property(companions GLOBAL PROPERTY BDPT_COMPANIONS)
  foreach(companion IN LISTS companions)
    add_custom_command(TARGET ${target} POST_BUILD
      COMMAND ${CMAKE_COMMAND} -E create_symlink "$<TARGET_FILE:${companion}>"
              "$<TARGET_FILE_DIR:${target}>/$<TARGET_FILE_NAME:${companion}>" VERBATIM)
  endforeach()
  if(BDPT_DENOISER)
    add_custom_command(TARGET ${target} POST_BUILD
      COMMAND ${CMAKE_COMMAND} -E create_symlink "${BDPT_DENOISER}" "$<TARGET_FILE_DIR:${target}>/denoiser" VERBATIM)
  endif()
  if(BDPT_KTX)
    add_custom_command(TARGET ${target} POST_BUILD
      COMMAND ${CMAKE_COMMAND} -E create_symlink "${BDPT_KTX}" "$<TARGET_FILE_DIR:${target}>/ktx" VERBATIM)
  endif()
endfunction()
