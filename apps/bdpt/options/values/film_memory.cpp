#include "options/values/film_memory.h"

#include <bdpt/film/exact_sum.h>
#include <bdpt/film/id_film.h>
#include <bdpt/options/integrators.h>

#include <array>
#include <utility>

namespace bdpt::app {
namespace {

constexpr std::uint64_t color_sum = 3 * sizeof(ExactSum);
constexpr std::uint64_t shadow_sums = 2 * sizeof(ExactSum) + sizeof(std::uint64_t);

/// Memory per pixel of an AOV: sums in an `AovFilm` or `IdFilm`, and floats of the developed layer.
struct AovCost {
    Aov aov;
    std::uint64_t sums;  // [bytes]
    std::uint64_t channels;
};

/// Typical cost of a pixel; each further id takes 8 bytes, and the heap's overhead.
constexpr std::uint64_t two_ids = sizeof(IdCounts) + 32;
constexpr std::uint64_t id_channels = 2 * IdFilm::levels;

constexpr std::array<AovCost, 11> aov_costs{{{Aov::albedo, color_sum, 3},
                                             {Aov::normal, color_sum, 3},
                                             {Aov::depth, sizeof(ExactSum), 1},
                                             {Aov::position, color_sum, 3},
                                             {Aov::sample_count, 0, 1},
                                             {Aov::variance, 0, 3},
                                             {Aov::alpha, sizeof(std::uint64_t), 1},
                                             {Aov::shadow, shadow_sums, 1},
                                             {Aov::opacity, sizeof(ExactSum), 1},
                                             {Aov::object, two_ids, id_channels},
                                             {Aov::material, two_ids, id_channels}}};

}  // namespace

std::uint64_t film_bytes(const RenderOptions& options, const Size& size)
{
    const bool splats = info(options.integrator).traces_light_paths;
    constexpr std::uint64_t halves = 2;
    std::uint64_t pixel = halves * (splats ? 2 : 1) * color_sum + sizeof(Rgb);
    for (const AovCost& cost : aov_costs) {
        if (options.film.aovs.contains(cost.aov)) {
            // Developed, and once more in the channel order of a file.
            pixel += cost.sums + 2 * cost.channels * sizeof(float);
        }
    }
    const PixelRect region = options.film.crop.value_or(
        PixelRect{.x0 = 0, .y0 = 0, .x1 = size.width, .y1 = size.height});
    return pixel * static_cast<std::uint64_t>(region.width()) *
           static_cast<std::uint64_t>(region.height());
}

}  // namespace bdpt::app
