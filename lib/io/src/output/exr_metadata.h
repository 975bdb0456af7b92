#pragma once

#include <OpenEXR/ImfHeader.h>
#include <bdpt/io/image_metadata.h>

namespace bdpt::io {

/// What the header of every OpenEXR file of ours says about its image. `aspect`: width over height
/// of the whole image.
void add_exr_metadata(Imf::Header& header, const ImageMetadata& metadata, float aspect);

}  // namespace bdpt::io
