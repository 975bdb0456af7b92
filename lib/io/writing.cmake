# Sources that write EXR, PNG and parts of renders.
find_package(PNG REQUIRED GLOBAL)
target_sources(bdpt_io PRIVATE
  src/output/camera_matrices.cpp
  src/output/display.cpp
  src/output/cryptomatte.cpp
  src/output/exr.cpp
  src/output/exr_metadata.cpp
  src/output/hdr.cpp
  src/output/image_metadata.cpp
  src/output/jpeg.cpp
  src/output/output_file.cpp
  src/output/output_target.cpp
  src/output/png.cpp
  src/output/temporary_file.cpp
  src/output/tone_curve.cpp
  src/output/tone_map.cpp
  src/output/webp.cpp
  src/part/id_json.cpp
  src/part/part_header.cpp
  src/part/part_planes.cpp
  src/part/part_reader.cpp
  src/part/part_seal.cpp
  src/part/part_writer.cpp
  src/part/rates_file.cpp
)
target_link_libraries(bdpt_io PRIVATE OpenEXR::OpenEXR Imath::Imath PNG::PNG fmt::fmt)
