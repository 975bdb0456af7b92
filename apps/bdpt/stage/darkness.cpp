#include "stage/darkness.h"

#include <bdpt/io/tone_map.h>
#include <bdpt/render.h>

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

}  // namespace bdpt::app
