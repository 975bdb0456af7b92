#include <bdpt/light/light_meter.h>

#include "camera/camera.h"
#include "geometry/flush_denormals.h"
#include "integrator/path/path_integrator.h"
#include "integrator/sample_schedule.h"
#include "math/frame.h"
#include "math/rgb.h"
#include "render/check_options.h"
#include "render/view.h"
#include "threads/threads.h"

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace bdpt {
namespace {

constexpr int side_of_grid = 32;     // of a square view [cards]
constexpr int max_paths = 1024;      // of a card
constexpr int max_path_length = 12;  // [edges] longer paths contribute next to nothing

RenderOptions grid_options(const LightMeterOptions& asked)
{
    constexpr std::uint64_t seed = 0x6d65746572;  // a seed that users will hardly choose
    constexpr int longest_side = 256;
    const float root = std::sqrt(asked.aspect);
    const auto side = [](float cards) {
        return static_cast<int>(
            std::clamp(std::round(cards), 1.0f, static_cast<float>(longest_side)));
    };
    RenderOptions options;
    options.integrator = IntegratorKind::mis;
    options.transport.max_depth = max_path_length;
    options.film.width = side(side_of_grid * root);
    options.film.height = side(side_of_grid / root);
    options.sampling.sampler = SamplerKind::sobol;  // random noise makes some cards too bright
    options.sampling.seed = seed;
    options.sampling.environment = EnvironmentSampling::plain;  // little noise in each card
    options.system.threads = asked.threads;
    return options;
}

/// Follows paths from white cards to lights, by path tracing with MIS.
class CardMeter {
public:
    CardMeter(const World& world, const MovingCamera& camera, const RenderOptions& options,
              int paths)
        : world_(world),
          camera_(camera),
          options_(options),
          paths_(paths),
          filter_(options.film.filter),
          paths_from_cards_(world, camera, options)
    {}

    /// Returns the luminance of the card at the surface that the pixel shows; nullopt if it shows
    /// none.
    [[nodiscard]] std::optional<double> card(int x, int y) const
    {
        double sum = 0.0;
        int cards = 0;
        for (int i = 0; i < paths_; ++i) {
            if (const std::optional<double> found = path(x, y, i)) {
                sum += *found;
                ++cards;
            }
        }
        return cards > 0 ? std::optional(sum / cards) : std::nullopt;
    }

private:
    [[nodiscard]] std::optional<double> path(int x, int y, int index) const
    {
        const SampleStart start(options_, filter_, world_, camera_, x, y, index);
        const TimedCamera timed(camera_, start.moment.time);
        RayCounts rays;
        SampleContext sample = start.context(world_, timed.get(), rays);
        sample.sampler.start(SampleUse::lens);
        const Vec2 u_lens = sample.camera.has_finite_lens() ? sample.sampler.next_2d() : Vec2(0.0f);
        const CameraRay ray = sample.camera.generate_ray(start.raster, u_lens);
        const auto hit = world_.first_hit(ray.lens, ray.direction, sample.segment(0, 1));
        if (!hit) {
            return std::nullopt;
        }
        const SegmentEnd end = world_.end_at(*hit, ray.direction, sample.time);
        const Vec3 normal = dot(end.ng, ray.direction) > 0.0f ? -end.ng : end.ng;
        SurfacePoint card([&] {
            return Bsdf(normal, Frame::from_normal(normal), -ray.direction, Lambertian(Rgb(1.0f)));
        });
        card.end = end;
        const auto found =
            static_cast<double>(luminance(paths_from_cards_.radiance_from(sample, card)));
        return std::isfinite(found) ? std::optional(found) : std::nullopt;
    }

    const World& world_;
    const MovingCamera& camera_;
    const RenderOptions& options_;
    int paths_;  // of a card
    PixelFilter filter_;
    PathIntegrator paths_from_cards_;
};

}  // namespace

std::vector<double> white_cards(const Scene& scene, const CameraDesc& camera,
                                const LightMeterOptions& asked)
{
    const RenderOptions options = grid_options(asked);
    check_options(options);
    check_range("number of paths of a card", asked.paths, 1, max_paths);
    check_camera(camera);
    check_camera_distance(camera, scene.world().farthest_origin());
    const MovingCamera opened = open_camera(scene.world(), camera, options);
    const CardMeter meter(scene.world(), opened, options, asked.paths);
    std::vector<std::vector<double>> rows(static_cast<std::size_t>(options.film.height));
    Threads threads(options.system.threads);
    threads.execute([&] {
        tbb::parallel_for(0, options.film.height, [&](int y) {
            const FlushDenormals flush;
            for (int x = 0; x < options.film.width; ++x) {
                if (const std::optional<double> card = meter.card(x, y)) {
                    rows[static_cast<std::size_t>(y)].push_back(*card);
                }
            }
        });
    });
    std::vector<double> cards;
    for (const std::vector<double>& row : rows) {
        cards.insert(cards.end(), row.begin(), row.end());
    }
    return cards;
}

double light_level(std::span<const double> cards)
{
    if (cards.empty()) {
        return 0.0;
    }
    std::vector<double> sorted(cards.begin(), cards.end());
    std::sort(sorted.begin(), sorted.end());
    const auto begin = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    const auto end = sorted.end() - static_cast<std::ptrdiff_t>(sorted.size() / 20);
    return std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
}

std::optional<float> light_exposure(double level)
{
    if (!(level > 0.0) || !std::isfinite(level)) {
        return std::nullopt;
    }
    return static_cast<float>(-std::log2(level));
}

}  // namespace bdpt
