#pragma once

#include <bdpt/image.h>
#include <bdpt/io/image_metadata.h>

#include <optional>
#include <string>

#include "options/values/exposure.h"

namespace bdpt::app {

/// Returns the exposure [EV] of an image whose `metadata` tell how it was rendered; if none is
/// requested, it is by light with a background and for frames, else automatic. Without metered
/// light an exposure by light falls back to automatic.
[[nodiscard]] float shown_exposure(const std::optional<Exposure>& asked,
                                   const io::ImageMetadata& metadata, const Image& image);

/// Throws `Error` (invalid_input) if the exposure is to be by light, and `what` was rendered
/// without metering it.
void check_metered(const std::optional<Exposure>& asked, const io::ImageMetadata& metadata,
                   const std::string& what);

}  // namespace bdpt::app
