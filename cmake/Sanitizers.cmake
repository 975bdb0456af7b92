# Applies to everything that is built here.
if(BDPT_SANITIZE)
  add_compile_options(-fsanitize=${BDPT_SANITIZE} -fno-omit-frame-pointer
                      -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${BDPT_SANITIZE})
endif()
