#include <bdpt/part/sample_rates.h>

#include "math/random_numbers.h"
#include "math/rgb.h"
#include "rates/rate_map.h"
#include "render/check_options.h"
#include "render/pass.h"
#include "render/view.h"
#include "threads/threads.h"

#include <bdpt/render.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace bdpt {
namespace {

/// Number of independent groups of samples, whose differences are noise.
constexpr int groups = 4;
constexpr std::int64_t samples_of_group = rate_pilot_samples / groups;
constexpr std::uint64_t pilot_seed = 0x6a09e667f3bcc908U;
/// Side of tiles in which all pixels are assumed to have the same cost [pixels].
constexpr int cost_side = 8;

/// Returns the options of the pilot.
RenderOptions pilot_options(const RenderOptions& chosen)
{
    RenderOptions options = chosen;
    options.film.crop.reset();
    options.film.aovs = {};
    options.sampling.samples = {.begin = 0, .end = samples_of_group};
    options.sampling.planned_samples = 0;
    options.bidirectional.strategy_depth = 0;
    options.system.tile_size = cost_side;
    return options;
}

/// Accumulates sums over groups of samples.
class PilotSums {
public:
    explicit PilotSums(const RenderOptions& options)
        : width_(options.film.width),
          pixels_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(options.film.height)),
          evidence_{.width = width_,
                    .height = options.film.height,
                    .variance = std::vector<double>(pixels_, 0.0),
                    .brightness = std::vector<double>(pixels_, 0.0),
                    .cost = std::vector<double>(pixels_, 1.0)},
          means_(pixels_, 0.0)
    {}

    /// Adds the cost of a tile. Safe from any thread, one per tile.
    void add_cost(const Tile& tile, const RenderStats& stats)
    {
        const int pixels = (tile.x_end - tile.x_begin) * (tile.y_end - tile.y_begin);
        const double rays = static_cast<double>(stats.rays.total()) / pixels;
        for (int y = tile.y_begin; y < tile.y_end; ++y) {
            for (int x = tile.x_begin; x < tile.x_end; ++x) {
                evidence_.cost[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                               static_cast<std::size_t>(x)] += rays;
            }
        }
    }

    /// Adds the samples of group number `group`, starting at 0.
    void add(const Film& film, int group)
    {
        const Image camera = film.develop_camera();
        const Image all = film.develop();
        for (std::size_t i = 0; i < pixels_; ++i) {
            evidence_.brightness[i] += static_cast<double>(luminance(all.pixels[i])) / groups;
            // [Welford 1962, "Note on a method for calculating corrected sums of squares and
            // products"]
            const auto value = static_cast<double>(luminance(camera.pixels[i]));
            const double before = value - means_[i];
            means_[i] += before / (group + 1);
            evidence_.variance[i] += before * (value - means_[i]) * samples_of_group / (groups - 1);
        }
    }

    [[nodiscard]] const RateEvidence& evidence() const { return evidence_; }

private:
    int width_;
    std::size_t pixels_;
    RateEvidence evidence_;
    std::vector<double> means_;
};

void render_group(const Scene& scene, const MovingCamera& camera, const RenderOptions& options,
                  const LearnedLight* learned, int group, PilotSums& sums)
{
    const auto integrator = make_integrator(scene.world(), camera, options, learned);
    RenderOptions without_aovs = options;
    without_aovs.film.aovs = {};
    const AovPass no_aovs(scene.world(), camera, without_aovs);
    FilmLayout layout = film_layout(options);
    layout.splats = SplatImage::apart;  // rates do not change their number
    RenderResult part{.identity = {},
                      .samples = {},
                      .film = Film(layout),
                      .aovs = {},
                      .ids = {},
                      .strategies = {},
                      .stats = {}};
    const std::function<void(const PathContribution&)> nobody;
    render_pass({.integrator = *integrator,
                 .aov_pass = no_aovs,
                 .on_path = nobody,
                 .on_tile = [&sums](const Tile& tile,
                                    const RenderStats& stats) { sums.add_cost(tile, stats); }},
                options, options.sampling.samples, part);
    sums.add(part.film, group);
}

}  // namespace

SampleRates sample_rates(const Scene& scene, const CameraDesc& camera_desc,
                         const RenderOptions& asked)
{
    RenderOptions options = asked;
    options.sampling.rates.reset();
    const RenderOptions chosen = choose_integrator(scene, camera_desc, options).options;
    options = pilot_options(chosen);
    check_takes_rates(options.integrator);
    const MovingCamera camera = open_camera(scene.world(), camera_desc, options);
    const auto learned = learned_light(scene.world(), camera_desc, chosen);
    Threads threads(options.system.threads);
    PilotSums sums(options);
    threads.execute([&] {
        for (int group = 0; group < groups; ++group) {
            options.sampling.seed = split_mix(pilot_seed + static_cast<std::uint64_t>(group));
            render_group(scene, camera, options, learned.get(), group, sums);
        }
    });
    return rates_for(sums.evidence());
}

}  // namespace bdpt
