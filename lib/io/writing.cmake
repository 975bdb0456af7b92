# Writing: EXR and PNG.
find_package(PNG REQUIRED GLOBAL)
target_sources(bdpt_io PRIVATE
  src/camera_matrices.cpp
  src/exr.cpp
  src/output_file.cpp
  src/picture_metadata.cpp
  src/png.cpp
  src/tone_map.cpp
)
target_link_libraries(bdpt_io PRIVATE OpenEXR::OpenEXR Imath::Imath PNG::PNG fmt::fmt)
