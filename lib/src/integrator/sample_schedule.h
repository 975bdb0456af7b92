#pragma once

#include "camera/camera.h"
#include "film/pixel_filter.h"
#include "math/sampler.h"
#include "path/sample_context.h"
#include "scene/world.h"

#include <bdpt/part/sample_rates.h>
#include <bdpt/render_options.h>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace bdpt {

/// Shutter time and wavelength, which both subpaths of a path must share.
struct TimeAndWavelength {
    float time = 0.0f;
    Wavelength wavelength = Wavelength::green;
};

/// Draws time and wavelength if the scene depends on them.
[[nodiscard]] inline TimeAndWavelength draw_time_and_wavelength(Sampler& sampler,
                                                                const World& world,
                                                                const MovingCamera& camera)
{
    TimeAndWavelength moment;
    if (world.disperses()) {
        moment.wavelength = choose_wavelength(sampler.next_1d());
    }
    if (world.moves() || camera.moves()) {
        moment.time = sampler.next_1d();
    }
    return moment;
}

/// Returns the number of samples that the whole render takes of a pixel, for `Sampler`.
[[nodiscard]] inline int log_samples(const SamplingOptions& sampling, int x, int y)
{
    constexpr std::int64_t most = 65536;  // points that are fast
    if (sampling.planned_samples == 0 || sampling.planned_samples > most) {
        return Sampler::open_ended;
    }
    const auto mean =
        static_cast<int>(std::bit_width(static_cast<std::uint64_t>(sampling.planned_samples) - 1));
    return std::clamp(mean + (sampling.rates ? sampling.rates->exponent(x, y) : 0), 0, 31);
}

/// Start of a pixel's sample, before any of its paths; the same for all integrators.
struct SampleStart {
    Sampler sampler;
    Vec2 raster;  ///< raster position of its camera path on the film [pixels]
    TimeAndWavelength moment;

    SampleStart(const RenderOptions& options, const PixelFilter& filter, const World& world,
                const MovingCamera& camera, int x, int y, std::int64_t index)
        : sampler(options.sampling.sampler, options.sampling.seed, x, y, index,
                  log_samples(options.sampling, x, y))
    {
        sampler.start(SampleUse::film);
        raster = filter.sample_raster(x, y, sampler.next_2d());
        moment = draw_time_and_wavelength(sampler, world, camera);
    }

    /// Returns the state of the sample for its paths; `camera` is the camera at its time.
    [[nodiscard]] SampleContext context(const World& world, const Camera& camera,
                                        RayCounts& rays) const
    {
        return {.world = world,
                .camera = camera,
                .sampler = sampler,
                .time = moment.time,
                .wavelength = moment.wavelength,
                .rays = rays};
    }
};

/// Factors of a sample's contributions.
struct SampleScale {
    float camera = 1.0f;  ///< factor of contributions to its own pixel
    float splat = 1.0f;   ///< factor of splats of its light path to any pixel
};

/// A scheduled sample of a pixel.
struct ScheduledSample {
    /// Index of its random numbers; the halves have even and odd ones.
    std::int64_t index = 0;
    std::int64_t round = 0;       ///< round of the light paths that all pixels share
    std::uint32_t sub_index = 0;  ///< distributes the samples that a pixel takes in a round [2^-32]
    SampleScale scale{};
};

/// Assignment of the pixels' samples to rounds. Without rates a round is one sample. With rates,
/// pixels take the first samples of each half in order, so that their points stay well distributed:
/// in round k of half h = k mod 2, which is round m = k div 2 of that half, a pixel of rate 2^e
/// takes samples m 2^e to (m + 1) 2^e - 1 of the half, if e is not negative; else sample m / 2^-e
/// where that is whole.
class SampleSchedule {
public:
    /// Keeps a reference to `options`, which must outlive this.
    explicit SampleSchedule(const RenderOptions& options)
        : rates_(options.sampling.rates.get()),
          splat_scale_(rates_ != nullptr ? static_cast<float>(1.0 / rates_->mean()) : 1.0f)
    {}

    /// Calls `visit` with each sample of pixel (x, y) of the image in these rounds.
    template <typename Visit>
    void for_each(int x, int y, SampleRange rounds, const Visit& visit) const
    {
        if (rates_ == nullptr) {
            for (std::int64_t k = rounds.begin; k < rounds.end; ++k) {
                visit(ScheduledSample{.index = k, .round = k});
            }
            return;
        }
        const int e = rates_->exponent(x, y);
        const SampleScale scale{.camera = SampleRates::to_rate(-e), .splat = splat_scale_};
        for (std::int64_t k = rounds.begin; k < rounds.end; ++k) {
            const std::int64_t half = k & 1;
            const std::int64_t m = k >> 1;
            const auto sample = [&](std::int64_t of_half, std::uint32_t sub_index) {
                visit(ScheduledSample{.index = 2 * of_half + half,
                                      .round = k,
                                      .sub_index = sub_index,
                                      .scale = scale});
            };
            if (e <= 0) {
                if ((m & ((std::int64_t{1} << -e) - 1)) == 0) {
                    sample(m >> -e, 0);
                }
                continue;
            }
            for (std::uint32_t i = 0; i < 1U << e; ++i) {
                sample((m << e) + i, i << (32 - e));
            }
        }
    }

    /// Returns the number of samples of pixel (x, y) in these rounds.
    [[nodiscard]] std::int64_t count(int x, int y, SampleRange rounds) const
    {
        const int e = rates_ == nullptr ? 0 : rates_->exponent(x, y);
        return count_before(rounds.end, e) - count_before(rounds.begin, e);
    }

private:
    /// Returns the number of samples in the rounds [0, round) at rate 2^e.
    [[nodiscard]] static std::int64_t count_before(std::int64_t round, int e)
    {
        const auto of_half = [e](std::int64_t rounds) {
            return e < 0 ? (rounds + (std::int64_t{1} << -e) - 1) >> -e : rounds << e;
        };
        return of_half((round + 1) / 2) + of_half(round / 2);
    }

    const SampleRates* rates_;
    float splat_scale_;
};

}  // namespace bdpt
