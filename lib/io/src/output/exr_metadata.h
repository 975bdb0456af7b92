#pragma once

#include <OpenEXR/ImfHeader.h>
#include <bdpt/io/write_image.h>

namespace bdpt::io {

/// Adds the metadata common to all our OpenEXR files. `aspect`: width over height of the whole
/// image.
void add_exr_metadata(Imf::Header& header, const ImageMetadata& metadata, float aspect);

}  // namespace bdpt::io
