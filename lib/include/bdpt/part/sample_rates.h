#pragma once

/// @file
/// Gives noisy pixels more samples than others.
///
/// @code{.cpp}
/// void render_adaptively(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     bdpt::RenderOptions options;
///     const bdpt::SampleRates rates = bdpt::sample_rates(scene, camera, options);
///     options.sampling.rates = std::make_shared<const bdpt::SampleRates>(rates);
///     const bdpt::RenderResult result = bdpt::render(scene, camera, options);
///     bdpt::io::write_exr("adaptive.exr", result.image(), {});
/// }
/// @endcode

#include <bdpt/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

class Scene;
struct CameraDesc;
struct RenderOptions;
struct SampleRange;

/// Mean number of samples that each pixel of an image takes per round: a power of two from 1/4 to
/// 4. In a render with rates (`SamplingOptions::rates`), rounds take the place of samples. Each
/// camera sample is weighted by 1 / rate, so that the sums of all pixels represent equally many
/// rounds.
class BDPT_EXPORT SampleRates {
public:
    /// Rates are 2^exponent, with exponents from min_exponent to max_exponent.
    static constexpr int min_exponent = -2;
    static constexpr int max_exponent = 2;
    /// Number of rounds, starting at a multiple of it, that gives each pixel samples in both halves
    /// of the film. Renders with rates begin and end at multiples of this number.
    static constexpr std::int64_t group = std::int64_t{2} << -min_exponent;
    /// Maximum number of rounds: pixels of the greatest rate take 2^32 samples.
    static constexpr std::int64_t max_rounds = std::int64_t{1} << (32 - max_exponent);

    /// Takes `exponents` row by row from the top left. Throws `Error` (usage) if there are not
    /// width x height of them, or if one is out of range.
    SampleRates(int width, int height, std::vector<std::int8_t> exponents);

    [[nodiscard]] int width() const { return width_; }    ///< width of the whole image [pixels]
    [[nodiscard]] int height() const { return height_; }  ///< height of the whole image [pixels]
    [[nodiscard]] const std::vector<std::int8_t>& exponents() const { return exponents_; }
    [[nodiscard]] int exponent(int x, int y) const
    {
        return exponents_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                          static_cast<std::size_t>(x)];
    }
    /// Returns the samples per round of pixel (x, y).
    [[nodiscard]] float rate(int x, int y) const { return to_rate(exponent(x, y)); }
    /// Returns the mean rate of the whole image, exact up to one rounding.
    [[nodiscard]] double mean() const { return mean_; }
    [[nodiscard]] float least() const;
    [[nodiscard]] float greatest() const;

    /// Tests whether `samples` can be rounds: they begin and end at multiples of `group`.
    [[nodiscard]] static bool fit(const SampleRange& samples);

    /// Returns 2^exponent.
    [[nodiscard]] static float to_rate(int exponent)
    {
        return static_cast<float>(1 << (exponent - min_exponent)) /
               static_cast<float>(1 << -min_exponent);
    }
    [[nodiscard]] bool operator==(const SampleRates&) const = default;

private:
    int width_;
    int height_;
    std::vector<std::int8_t> exponents_;
    double mean_;
};

/// Samples per pixel that the pilot of `sample_rates` renders.
inline constexpr std::int64_t rate_pilot_samples = 8;

/// Computes rates that suit the image: higher where the variance of camera samples is large
/// relative to the local brightness, lower elsewhere. Their mean is 1 or slightly less. A pilot of
/// `rate_pilot_samples` samples with its own random numbers determines them; its samples enter no
/// image, so a render with these rates is unbiased. A pure function of scene, camera and options:
/// independent of seed, samples, crop, threads and `SamplingOptions::rates`. Throws `Error` like
/// render(), and (usage) for integrators that do not support rates: lt and vcm.
[[nodiscard]] BDPT_EXPORT SampleRates sample_rates(const Scene& scene, const CameraDesc& camera,
                                                   const RenderOptions& options);

}  // namespace bdpt
