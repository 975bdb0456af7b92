#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace bdpt::app {

/// Reference of an exposure.
enum class ExposureBase : std::uint8_t {
    radiance,   ///< pixel values as they are: the value is absolute
    automatic,  ///< exposure by the image's average luminance
    light,      ///< exposure that makes a white card at the scene's position white
};

/// Exposure of images for screens.
struct Exposure {
    ExposureBase base = ExposureBase::radiance;
    float value = 0.0f;  ///< relative to the base [EV]
};

/// Parses "1.5" or "+1.5", relative to radiance; "auto", "light", and either followed by a signed
/// number: "light-0.5".
[[nodiscard]] std::optional<Exposure> parse_exposure(const std::string& text);

}  // namespace bdpt::app
