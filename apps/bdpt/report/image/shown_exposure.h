#pragma once

#include <bdpt/image.h>
#include <bdpt/io/image_metadata.h>

#include <optional>
#include <string>

#include "options/values/exposure.h"

namespace bdpt::app {

/// The exposure [EV] of an image of which `metadata` tells how it was rendered; if none is asked
/// for, by light before a background and for frames, else automatic. It is automatic in place
/// of that by light if none was metered.
[[nodiscard]] float shown_exposure(const std::optional<Exposure>& asked,
                                   const io::ImageMetadata& metadata, const Image& image);

/// Throws `Error` (invalid_input) where the exposure is to be that by light, and `what` was
/// rendered without metering it.
void check_metered(const std::optional<Exposure>& asked, const io::ImageMetadata& metadata,
                   const std::string& what);

}  // namespace bdpt::app
