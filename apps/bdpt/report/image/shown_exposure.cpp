#include "report/image/shown_exposure.h"

#include <bdpt/error.h>
#include <bdpt/io/tone_map.h>
#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace bdpt::app {
namespace {

nlohmann::json settings_in(const io::ImageMetadata& metadata)
{
    return nlohmann::json::parse(metadata.settings, nullptr, false);
}

std::optional<float> metered_in(const nlohmann::json& settings)
{
    if (!settings.is_object() || !settings.contains("light_exposure") ||
        !settings["light_exposure"].is_number()) {
        return std::nullopt;
    }
    return settings["light_exposure"].get<float>();
}

}  // namespace

float shown_exposure(const std::optional<Exposure>& asked, const io::ImageMetadata& metadata,
                     const Image& image)
{
    const nlohmann::json settings = settings_in(metadata);
    const Exposure exposure = asked.value_or(Exposure{.base = ExposureBase::light});
    if (exposure.base == ExposureBase::radiance) {
        return exposure.value;
    }
    // Light is metered only if that is the default, or requested.
    const std::optional<float> metered =
        exposure.base == ExposureBase::light ? metered_in(settings) : std::nullopt;
    return exposure.value + (metered ? *metered : io::automatic_exposure(image));
}

void check_metered(const std::optional<Exposure>& asked, const io::ImageMetadata& metadata,
                   const std::string& what)
{
    if (asked && asked->base == ExposureBase::light && !metered_in(settings_in(metadata))) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("--exposure light: the incident light of {} was not metered; "
                                "render with --exposure light or --background",
                                what));
    }
}

}  // namespace bdpt::app
