# Sources that write EXR, PNG and parts of renders.
find_package(PNG REQUIRED GLOBAL)
target_sources(bdpt_io PRIVATE
  src/output/image_metadata.cpp
  src/output/display.cpp
  src/output/exr.cpp
  src/output/hdr.cpp
  src/output/jpeg.cpp
  src/output/output_file.cpp
  src/output/output_target.cpp
  src/output/png.cpp
  src/output/webp.cpp
  src/part/part_header.cpp
  src/part/part_planes.cpp
  src/part/part_reader.cpp
  src/part/part_seal.cpp
  src/part/part_writer.cpp
  src/part/rates_file.cpp
)
target_link_libraries(bdpt_io PRIVATE OpenEXR::OpenEXR Imath::Imath PNG::PNG fmt::fmt)
