#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace bdpt::app {

/// What an exposure is counted from.
enum class ExposureBase : std::uint8_t {
    radiance,   ///< pixels as they are: the value is all there is
    automatic,  ///< what makes the image neither dark nor bright
    light,      ///< what makes a white card white that stands where the scene stands
};

/// How bright images are shown.
struct Exposure {
    ExposureBase base = ExposureBase::radiance;
    float value = 0.0f;  ///< [EV] beyond the base
};

/// "1.5" or "+1.5", which counts from radiance; "auto", "light", and both with a number behind them
/// that has a sign: "light-0.5".
[[nodiscard]] std::optional<Exposure> parse_exposure(const std::string& text);

}  // namespace bdpt::app
