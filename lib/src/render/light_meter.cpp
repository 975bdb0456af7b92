#include <bdpt/light/light_meter.h>

#include "camera/moving_camera.h"
#include "geometry/flush_denormals.h"
#include "integrator/sample_start.h"
#include "math/frame.h"
#include "math/rgb.h"
#include "path/segment_sample.h"
#include "render/check_options.h"
#include "render/open_camera.h"
#include "threads/threads.h"

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>

namespace bdpt {
namespace {

constexpr int side_of_grid = 32;       // of a square view [cards]
constexpr int max_paths = 1024;        // of a card
constexpr int max_walk_vertices = 12;  // [vertices] later vertices contribute next to nothing
constexpr int roulette_start = 4;      // [vertices]
constexpr float survival = 0.75f;      // survival probability at each vertex from there on
constexpr NextEventSampling next_event_sampling{.environments = EnvironmentSampling::plain,
                                                .lights = LightSampling::automatic};

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
    options.film.width = side(side_of_grid * root);
    options.film.height = side(side_of_grid / root);
    options.sampling.sampler = SamplerKind::sobol;  // random noise makes some cards too bright
    options.sampling.seed = seed;
    options.system.threads = asked.threads;
    return options;
}

/// Traces paths from white cards to lights, like path tracing with MIS.
class CardMeter {
public:
    CardMeter(const World& world, const MovingCamera& camera, const RenderOptions& options,
              int paths)
        : world_(world),
          camera_(camera),
          options_(options),
          paths_(paths),
          filter_(options.film.filter)
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
        SampleContext sample{.world = world_,
                             .camera = timed.get(),
                             .sampler = start.sampler,
                             .time = start.moment.time,
                             .wavelength = start.moment.wavelength,
                             .rays = rays};
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
        const auto found = static_cast<double>(luminance(light_at(sample, card)));
        return std::isfinite(found) ? std::optional(found) : std::nullopt;
    }

    /// Returns the light scattered at the first vertex, and at the later vertices of a path from
    /// it.
    [[nodiscard]] Rgb light_at(SampleContext& sample, SurfacePoint point) const
    {
        Sampler& sampler = sample.sampler;
        Rgb light(0.0f);
        Rgb beta(1.0f);
        for (int vertices = 2;; ++vertices) {
            const bool samples_lights = point.bsdf.connectible();
            if (samples_lights) {
                light += beta * sampled_light(sample, point, vertices);
            }
            if (vertices == max_walk_vertices) {
                return light;
            }
            sampler.start(SampleUse::camera_walk, static_cast<std::uint32_t>(vertices));
            const Vec2 u_direction = sampler.next_2d();
            const float u_lobe = point.bsdf.has_one_lobe() ? 0.0f : sampler.next_1d();
            const auto scattered = point.bsdf.sample(u_lobe, u_direction, TransportMode::radiance);
            beta = scattered ? beta * scattered->weight : Rgb(0.0f);
            if (vertices >= roulette_start) {
                beta = sampler.next_1d() < survival ? beta / survival : Rgb(0.0f);
            }
            if (is_black(beta)) {
                return light;
            }
            const SegmentEnd origin = point.end;
            Departure from{.p = origin.p, .pdf = scattered->pdf_fwd};
            if (samples_lights && !scattered->delta) {
                from.receiver = {.p = origin.p, .normal = point.bsdf.opaque_normal()};
            }
            const SegmentKey segment = sample.segment(0, vertices);
            const SegmentSample met =
                sample_segment(sample, origin, scattered->wi, segment,
                               {.from_camera = true, .vertices = vertices, .beta = beta});
            beta *= met.weight();
            if (met.is_nothing()) {
                return light + beta * sky(from, scattered->wi);
            }
            point = make_interaction(sample, met, origin, scattered->wi, segment);
            if (point.light) {
                const LightPoint at{.p = point.end.p,
                                    .ng = point.end.ng,
                                    .barycentrics = point.barycentrics,
                                    .time = sample.time};
                light += beta * point.emission * share(from, *point.light, at);
            }
        }
    }

    /// Origin of a ray that may hit a light.
    struct Departure {
        Vec3 p{0.0f};
        SolidAnglePdf pdf;
        std::optional<LightSampleContext> receiver{};  ///< set if lights are sampled there
    };

    [[nodiscard]] Rgb sky(const Departure& from, Vec3 direction) const
    {
        const auto id = world_.lights().environment();
        return id ? std::get<EnvironmentLight>(world_.lights()[*id].model()).radiance(direction) *
                        share(from, *id, {.p = direction})
                  : Rgb(0.0f);
    }

    /// Returns the MIS weight of a light that a ray hits, against light sampling.
    [[nodiscard]] float share(const Departure& from, LightId id, const LightPoint& met) const
    {
        if (!from.receiver) {
            return 1.0f;
        }
        const Light& light = world_.lights()[id];
        const float by_light =
            world_.lights().next_event_pdf(id, met, *from.receiver, next_event_sampling).value;
        const Vec3 along = met.p - from.p;
        const float squared = dot(along, along);
        const float by_ray =
            light.is_infinite()
                ? from.pdf.value
                : to_area(from.pdf, std::abs(dot(met.ng, along)) / std::sqrt(squared), squared)
                      .value;
        return by_ray > 0.0f ? by_ray / (by_ray + by_light) : 0.0f;
    }

    [[nodiscard]] Rgb sampled_light(SampleContext& sample, const SurfacePoint& point,
                                    int vertices) const
    {
        Sampler& sampler = sample.sampler;
        sampler.start(SampleUse::next_event, static_cast<std::uint32_t>(vertices));
        const Vec2 u = sampler.next_2d();
        const LightSet::NextEvent next = world_.lights().sample_next_event(
            {.p = point.end.p, .normal = point.bsdf.opaque_normal()}, u,
            [&sampler] { return sampler.next_fine(); }, next_event_sampling, sample.time);
        const auto& incident = next.incident;
        if (!incident) {
            return Rgb(0.0f);
        }
        const Light& light = world_.lights()[next.light];
        const BsdfEval f = point.bsdf.eval(incident->wi, TransportMode::radiance);
        if (is_black(f.f_cos * incident->weight)) {
            return Rgb(0.0f);
        }
        const SegmentKey segment = sample.segment(1, vertices);
        const auto transmission =
            light.is_infinite() ? world_.transmission_to_infinity(point.end, incident->wi, segment)
                                : world_.transmission(point.end, incident->end, segment);
        if (!transmission) {
            return Rgb(0.0f);
        }
        const float by_light = incident->pdf_solid_angle.value * next.probability;
        const float by_ray = light.is_delta() ? 0.0f : f.pdf_fwd.value;
        const Rgb value = f.f_cos * light.incident_weight(*incident);
        return value * transmission->transmittance / next.probability *
               (by_light / (by_light + by_ray));
    }

    const World& world_;
    const MovingCamera& camera_;
    const RenderOptions& options_;
    int paths_;  // of a card
    PixelFilter filter_;
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
