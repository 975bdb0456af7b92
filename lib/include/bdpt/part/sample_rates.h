#pragma once

#include <bdpt/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

class Scene;
struct CameraDesc;
struct RenderOptions;

/// How many samples each pixel of an image takes in a round, in the mean: a power of two, from 1/4
/// to 4. A render with rates (`SamplingOptions::rates`) has rounds where others have samples. Each
/// camera sample counts 1 / rate, so that all pixels have the sums of equally many rounds.
class BDPT_EXPORT SampleRates {
public:
    /// Rates are 2^exponent, from min_exponent to max_exponent.
    static constexpr int min_exponent = -2;
    static constexpr int max_exponent = 2;
    /// So many rounds, from a multiple of that on, give each pixel samples in both halves of the
    /// film. Renders with rates begin and end there.
    static constexpr std::int64_t group = std::int64_t{2} << -min_exponent;

    /// `exponents` go row by row from the top left. Throws `Error` (usage) when they are not width
    /// x height, or out of range.
    SampleRates(int width, int height, std::vector<std::int8_t> exponents);

    [[nodiscard]] int width() const { return width_; }    ///< of the whole image [pixels]
    [[nodiscard]] int height() const { return height_; }  ///< of the whole image [pixels]
    [[nodiscard]] const std::vector<std::int8_t>& exponents() const { return exponents_; }
    [[nodiscard]] int exponent(int x, int y) const
    {
        return exponents_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                          static_cast<std::size_t>(x)];
    }
    /// Samples per round.
    [[nodiscard]] float rate(int x, int y) const { return rate_of(exponent(x, y)); }
    /// The mean rate of the whole image, exact but for one rounding.
    [[nodiscard]] double mean() const { return mean_; }
    [[nodiscard]] float least() const;
    [[nodiscard]] float greatest() const;

    /// 2^exponent
    [[nodiscard]] static float rate_of(int exponent)
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

/// Samples a pixel that `sample_rates` renders for itself.
inline constexpr std::int64_t rate_pilot_samples = 8;

/// Rates that suit the image: more where camera samples vary much for the brightness of the place,
/// fewer where they do not. Their mean is 1 or a little less. A pilot of `rate_pilot_samples`
/// samples of random numbers of its own finds them; they do not enter any image, so a render with
/// these rates is unbiased. A pure function of scene, camera and options: not of seed, samples,
/// crop, threads or `SamplingOptions::rates`. Throws `Error` as render() does, and (usage) for
/// integrators that cannot be given rates: lt and vcm.
[[nodiscard]] BDPT_EXPORT SampleRates sample_rates(const Scene& scene, const CameraDesc& camera,
                                                   const RenderOptions& options);

}  // namespace bdpt
