# Reading: glTF scenes, textures, environment maps.
target_sources(bdpt_io PRIVATE
  # files, JSON
  src/file/json_parser.cpp
  src/file/json_place.cpp
  src/file/read_file.cpp
  src/file/uri.cpp
  src/file/warnings.cpp
  # pictures
  src/image/cube_map.cpp
  src/image/environment.cpp
  src/image/exr_channels.cpp
  src/image/exr_header.cpp
  src/image/exr_reader.cpp
  src/image/hdr_reader.cpp
  src/image/oiio_library.cpp
  src/image/read_image.cpp
  src/image/texels.cpp
  src/image/webp_header.cpp
  # light profiles
  src/ies/ies_file.cpp
  src/ies/ies_numbers.cpp
  src/ies/ies_profile.cpp
  # glTF: checks before tinygltf
  src/gltf/decoded_size.cpp
  src/gltf/draco_primitives.cpp
  src/gltf/extensions.cpp
  src/gltf/glb.cpp
  src/gltf/layout.cpp
  src/gltf/lens.cpp
  src/gltf/meshopt_views.cpp
  src/gltf/node_graph.cpp
  src/gltf/prepass.cpp
  src/gltf/schema.cpp
  # glTF: structs by tinygltf
  src/gltf/model.cpp
  src/gltf/tinygltf.cpp
  # glTF: structs to SceneDesc
  src/gltf/accessor.cpp
  src/gltf/animation.cpp
  src/gltf/attributes.cpp
  src/gltf/camera.cpp
  src/gltf/data_budget.cpp
  src/gltf/facts.cpp
  src/gltf/gltf.cpp
  src/gltf/image_based_light.cpp
  src/gltf/image_table.cpp
  src/gltf/instancing.cpp
  src/gltf/keyframes.cpp
  src/gltf/light.cpp
  src/gltf/light_profiles.cpp
  src/gltf/material.cpp
  src/gltf/material_layers.cpp
  src/gltf/material_table.cpp
  src/gltf/material_values.cpp
  src/gltf/mesh.cpp
  src/gltf/mesh_table.cpp
  src/gltf/morph.cpp
  src/gltf/motion.cpp
  src/gltf/node_motion.cpp
  src/gltf/node_transforms.cpp
  src/gltf/placement.cpp
  src/gltf/primitive_reader.cpp
  src/gltf/scene_builder.cpp
  src/gltf/select_scene.cpp
  src/gltf/selection.cpp
  src/gltf/skin.cpp
  src/gltf/specular_glossiness.cpp
  src/gltf/texture.cpp
  src/gltf/transform.cpp
  src/gltf/variants.cpp
)
# Decoders of compressed meshes, as far as they are installed (cmake/Dependencies.cmake).
if(BDPT_HAS_DRACO)
  target_sources(bdpt_io PRIVATE src/gltf/draco_decoder.cpp)
  target_link_libraries(bdpt_io PRIVATE draco::draco)
else()
  target_sources(bdpt_io PRIVATE src/gltf/draco_absent.cpp)
endif()
if(BDPT_HAS_MESHOPT)
  target_sources(bdpt_io PRIVATE src/gltf/meshopt_decoder.cpp)
  target_link_libraries(bdpt_io PRIVATE meshoptimizer::meshoptimizer)
else()
  target_sources(bdpt_io PRIVATE src/gltf/meshopt_absent.cpp)
endif()
target_include_directories(bdpt_io SYSTEM PRIVATE ${BDPT_TINYGLTF_INCLUDE_DIR})
target_link_libraries(bdpt_io PRIVATE
  OpenEXR::OpenEXR Imath::Imath TBB::tbb $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> fmt::fmt
  ${CMAKE_DL_LIBS})

# tinygltf gets checked JSON and buffers from memory; it opens no files and decodes no pictures.
target_compile_definitions(bdpt_io PRIVATE
  TINYGLTF_NO_STB_IMAGE TINYGLTF_NO_STB_IMAGE_WRITE TINYGLTF_NO_EXTERNAL_IMAGE TINYGLTF_NO_FS
  TINYGLTF_NO_INCLUDE_JSON)
# The implementation's warnings are not ours to mend.
set_source_files_properties(src/gltf/tinygltf.cpp PROPERTIES COMPILE_OPTIONS "-w")

# OpenImageIO lives in a module that is loaded with the first picture (src/image/oiio_library.h).
add_library(bdpt_oiio MODULE src/oiio_module/oiio_module.cpp)
bdpt_compile_options(bdpt_oiio)
target_include_directories(bdpt_oiio PRIVATE src)
target_link_libraries(bdpt_oiio PRIVATE OpenImageIO::OpenImageIO)
add_dependencies(bdpt_io bdpt_oiio)
# Where it is looked for, relative to what holds the code: beside it in the build tree and in bdpt/
# when installed. A static library ends up in a program that may lie anywhere.
set(folders [["."]] [["bdpt"]])
if(NOT BUILD_SHARED_LIBS)
  file(RELATIVE_PATH from_bindir "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
  list(APPEND folders "\"${from_bindir}/bdpt\"" "\"${CMAKE_INSTALL_FULL_LIBDIR}/bdpt\""
       "\"$<TARGET_FILE_DIR:bdpt_oiio>\"")
endif()
list(JOIN folders "," folders)
set_source_files_properties(src/image/oiio_library.cpp PROPERTIES
  COMPILE_DEFINITIONS "BDPT_OIIO_FOLDERS=${folders}")
