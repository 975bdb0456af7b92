#include "stage/darkness.h"

#include <bdpt/io/tone_map.h>
#include <bdpt/render.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt::app {
namespace {

constexpr int longest_side = 24;  // [pixels], so few that it takes some milliseconds
constexpr std::int64_t samples = 4;
constexpr std::uint8_t black = 16;  // of 255: below it nothing can be told apart

/// A side of the small render [pixels].
int shrunk(int side, int longest)
{
    return std::max(1, static_cast<int>(static_cast<std::int64_t>(side) * longest_side / longest));
}

}  // namespace

double dark_share(const PreparedScene& stage, RenderOptions options,
                  const std::optional<float>& exposure)
{
    const int longest = std::max({stage.size.width, stage.size.height, longest_side});
    options.integrator = IntegratorKind::bdpt;
    options.film.width = shrunk(stage.size.width, longest);
    options.film.height = shrunk(stage.size.height, longest);
    options.film.crop.reset();
    options.film.aovs = AovSet{Aov::alpha};
    options.sampling.samples = {0, samples};
    options.sampling.rates.reset();
    options.bidirectional.disabled.clear();
    options.bidirectional.strategy_depth = 0;
    const RenderResult result = render(stage.scene, stage.camera, options);
    const Image image = result.film.develop();
    const io::DisplayImage shown =
        io::tone_map(image, exposure.value_or(io::automatic_exposure(image)));
    const std::vector<float> covered = result.aovs.develop(result.film).at(0).values;
    int seen = 0;
    int dark = 0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
        if (covered[i] > 0.5f) {
            const auto pixel = shown.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i);
            ++seen;
            dark += *std::max_element(pixel, pixel + 3) < black ? 1 : 0;
        }
    }
    return seen > 0 ? static_cast<double>(dark) / seen : 0.0;
}

std::optional<std::string> warning_of_darkness(const RenderArguments& arguments,
                                               const PreparedScene& stage)
{
    constexpr double nearly_all = 0.9;
    if (!stage.only_emitters || arguments.environment) {
        return std::nullopt;
    }
    const double dark = dark_share(stage, arguments.options, arguments.display.exposure);
    if (dark < nearly_all) {
        return std::nullopt;
    }
    return fmt::format(
        "{}: nearly black: the only lights of the file are surfaces that emit, and {:.0f} % of "
        "what "
        "the camera sees gets next to no light; --env default adds a soft sky",
        arguments.file.string(), 100.0 * dark);
}

}  // namespace bdpt::app
