# Writing: EXR and PNG.
find_package(PNG REQUIRED GLOBAL)
target_sources(bdpt_io PRIVATE
  src/output/camera_matrices.cpp
  src/output/exr.cpp
  src/output/image_metadata.cpp
  src/output/output_file.cpp
  src/output/png.cpp
  src/output/tone_map.cpp
)
target_link_libraries(bdpt_io PRIVATE OpenEXR::OpenEXR Imath::Imath PNG::PNG fmt::fmt)
