# Sources that read glTF scenes, textures and environment maps.
target_sources(bdpt_io PRIVATE
  # files, JSON, and the memory limit of loading
  src/file/read_file.cpp
  src/file/load_context.cpp
  src/file/json_parser.cpp
  src/file/json_value.cpp
  src/file/messages.cpp
  src/file/uri.cpp
  # textures
  src/image/cube_map.cpp
  src/image/encoded_image.cpp
  src/image/jpeg_image.cpp
  src/image/ktx2_image.cpp
  src/image/png_image.cpp
  src/image/webp_image.cpp
  # images as linear radiance: OpenEXR, Radiance HDR, TIFF, and display-referred formats
  src/image/linear/display_reader.cpp
  src/image/linear/read_image.cpp
  src/image/linear/exr_reader.cpp
  src/image/linear/exr_header.cpp
  src/image/linear/hdr_reader.cpp
  src/image/linear/tiff_reader.cpp
  # denoising with a library that is opened at run time
  src/denoise/denoiser.cpp
  # light profiles
  src/ies/ies_file.cpp
  src/ies/ies_profile.cpp
  # programs that read files in separate processes
  src/process/child_process.cpp
  # volumes: OpenVDB, in such a program
  src/volume/volume.cpp
  # glTF: checks a document before any library parses it. Each glTF folder includes only those above it in this list
  src/gltf/checks/animations.cpp
  src/gltf/checks/glb.cpp
  src/gltf/checks/layout.cpp
  src/gltf/checks/schema.cpp
  # glTF: Draco and meshoptimizer
  src/gltf/compression/meshopt_views.cpp
  src/gltf/compression/draco_decoder.cpp
  src/gltf/compression/draco_primitives.cpp
  src/gltf/compression/meshopt_decoder.cpp
  # glTF: bytes to the structs of tinygltf
  src/gltf/document/accessor.cpp
  src/gltf/document/extensions.cpp
  src/gltf/document/facts.cpp
  src/gltf/document/model.cpp
  src/gltf/document/prepass.cpp
  # glTF: node transforms over time
  src/gltf/animation/animation.cpp
  src/gltf/animation/instancing.cpp
  src/gltf/animation/keyframes.cpp
  src/gltf/animation/node_motion.cpp
  src/gltf/animation/node_transforms.cpp
  # glTF: meshes
  src/gltf/geometry/attributes.cpp
  src/gltf/geometry/mesh.cpp
  src/gltf/geometry/mesh_table.cpp
  src/gltf/geometry/placement.cpp
  src/gltf/geometry/skin.cpp
  # glTF: materials and their images
  src/gltf/material/image_table.cpp
  src/gltf/material/material.cpp
  src/gltf/material/material_layers.cpp
  src/gltf/material/material_table.cpp
  src/gltf/material/texture.cpp
  # glTF: lights and cameras
  src/gltf/light_camera/camera.cpp
  src/gltf/light_camera/image_based_light.cpp
  src/gltf/light_camera/lens.cpp
  src/gltf/light_camera/light.cpp
  src/gltf/light_camera/light_profiles.cpp
  src/gltf/light_camera/motion.cpp
  # glTF: structs of tinygltf to SceneDesc
  src/gltf/scene/load_gltf.cpp
)
# Decodes compressed meshes with the installed libraries (cmake/Dependencies.cmake).
if(BDPT_HAS_DRACO)
  target_compile_definitions(bdpt_io PRIVATE BDPT_HAS_DRACO)
  target_link_libraries(bdpt_io PRIVATE draco::draco)
endif()
if(BDPT_HAS_MESHOPT)
  target_compile_definitions(bdpt_io PRIVATE BDPT_HAS_MESHOPT)
  target_link_libraries(bdpt_io PRIVATE meshoptimizer::meshoptimizer)
endif()
target_include_directories(bdpt_io SYSTEM PRIVATE ${BDPT_TINYGLTF_INCLUDE_DIR})
target_link_libraries(bdpt_io PRIVATE
  OpenEXR::OpenEXR Imath::Imath JPEG::JPEG WebP::webp WebP::webpdemux TBB::tbb $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> fmt::fmt
  ${CMAKE_DL_LIBS})

# OpenImageIO is in a module that is loaded for the first TIFF image (src/image/linear/tiff_reader.cpp).
if(BDPT_HAS_OPENIMAGEIO)
  add_library(bdpt_oiio MODULE src/oiio_module/oiio_module.cpp)
  bdpt_compile_options(bdpt_oiio)
  target_include_directories(bdpt_oiio PRIVATE src)
  target_link_libraries(bdpt_oiio PRIVATE OpenImageIO::OpenImageIO)
  bdpt_add_companion(bdpt_oiio)
endif()

# bdpt_add_reader(TARGET NAME SOURCES...): a program that reads one file of a stranger, in a process of its own.
function(bdpt_add_reader target name)
  add_executable(${target} src/process/limited_process.cpp ${ARGN})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name})
  bdpt_compile_options(${target})
  target_include_directories(${target} PRIVATE src $<TARGET_PROPERTY:bdpt,INTERFACE_INCLUDE_DIRECTORIES>)
  if(BDPT_SANITIZE)
    target_compile_definitions(${target} PRIVATE BDPT_SANITIZED)
  endif()
  if(BDPT_HAS_SECCOMP)
    target_compile_definitions(${target} PRIVATE BDPT_HAS_SECCOMP)
    target_include_directories(${target} SYSTEM PRIVATE "${BDPT_SECCOMP_INCLUDE_DIR}")
    target_link_libraries(${target} PRIVATE "${BDPT_SECCOMP_LIBRARY}")
  endif()
  bdpt_add_companion(${target})
endfunction()

# OpenVDB is in a program that runs once for each volume file (src/process/reader_program.h).
if(BDPT_HAS_OPENVDB)
  bdpt_add_reader(bdpt_vdb_reader bdpt-read-vdb src/vdb_reader/main.cpp)
  target_link_libraries(bdpt_vdb_reader PRIVATE bdpt_openvdb glm::glm)
endif()

# A program that runs once for each KTX2 image opens libktx (src/process/reader_program.h).
bdpt_add_reader(bdpt_ktx_reader bdpt-read-ktx src/ktx_reader/main.cpp)
target_link_libraries(bdpt_ktx_reader PRIVATE ${CMAKE_DL_LIBS})

# The library looks for its companions beside the file that contains its code (the shared library, or the program that
# links the static one), and in the installed folder relative to it. It never looks in the build folder: anyone who can
# write there could inject code.
set(folders [["."]] [["bdpt"]])
if(BUILD_SHARED_LIBS)
  bdpt_put_companions_beside(bdpt_io)
elseif(NOT DEFINED SKBUILD)  # in a wheel the program and the module are beside them
  file(RELATIVE_PATH from_bindir "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
  list(APPEND folders "\"${from_bindir}/bdpt\"")
endif()
list(JOIN folders "," folders)
set_source_files_properties(src/file/read_file.cpp PROPERTIES
  COMPILE_DEFINITIONS "BDPT_COMPANION_FOLDERS=${folders}")
if(DEFINED SKBUILD)
  set_source_files_properties(src/denoise/denoiser.cpp PROPERTIES COMPILE_DEFINITIONS BDPT_IN_PYTHON_PACKAGE)
endif()
