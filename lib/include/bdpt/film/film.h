#pragma once

/// @file
/// Holds the sums of a render, from which its image is developed.
///
/// @code{.cpp}
/// bdpt::Image image_of_both(bdpt::Film film, const bdpt::Film& other_samples)
/// {
///     film.merge(other_samples);  // exact, in any order
///     if (film.defects().invalid > 0) {
///         std::cerr << "contributions were NaN, infinite or negative\n";
///     }
///     return film.develop();
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/film/exact_sum.h>
#include <bdpt/image.h>
#include <bdpt/pixel_rect.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bdpt {

/// Contributions that could not be added unchanged. All zero after a correct render.
struct FilmDefects {
    std::uint64_t invalid = 0;    ///< NaN, infinite or negative: dropped
    std::uint64_t saturated = 0;  ///< above ExactSum::max_value: clamped to it

    /// A sample of a pixel.
    struct Place {
        int x = 0;
        int y = 0;
        std::int64_t sample_index = 0;
        [[nodiscard]] bool operator==(const Place&) const = default;
    };
    /// The pixel sample with the lowest index (then row, then column) that gave an invalid value.
    std::optional<Place> first_invalid;
};

/// Where a film adds splats, the contributions of light paths to any pixel.
enum class SplatImage : std::uint8_t {
    absent,   ///< nowhere
    present,  ///< to the sums of camera samples
    apart     ///< to sums of their own, which double the memory
};

/// The size and the buffers of a film.
struct FilmLayout {
    int width = 0;  ///< width of the whole image [pixels]
    int height = 0;
    PixelRect region;  ///< the part of the image that the film holds: not empty, inside
    SplatImage splats = SplatImage::present;
    /// Maximum component [nit] of one contribution; larger ones are scaled down.
    float clamp = std::numeric_limits<float>::infinity();
    [[nodiscard]] bool operator==(const FilmLayout&) const = default;
};

/// The totals of a film that files store beside the sums of its pixels.
struct FilmTotals {
    FilmDefects defects;
    std::array<ExactSum::Words, 3> clamped{};  ///< sum of the radiance that clamping removed
    ExactSum::Words clamped_contributions{};
};

/// The radiance that clamping removed from the estimate.
struct ClampLoss {
    std::uint64_t contributions = 0;  ///< number of contributions that were scaled down
    Rgb radiance{0.0f};               ///< mean over the pixels of the region [nit]
};

/// The sums of a render: for each pixel the sum of its own camera samples and of the splats of
/// light paths, in two halves (even and odd sample index). All positions refer to the whole image,
/// even if the film holds only a part of it.
class BDPT_EXPORT Film {
public:
    Film() = default;
    explicit Film(const FilmLayout& layout);
    Film(Film&&) noexcept;
    Film& operator=(Film&&) noexcept;

    [[nodiscard]] const FilmLayout& layout() const { return layout_; }
    [[nodiscard]] const PixelRect& region() const { return layout_.region; }
    /// Returns the size of the film's region [pixels].
    [[nodiscard]] int width() const { return region().width(); }
    [[nodiscard]] int height() const { return region().height(); }
    /// Returns the samples per pixel (and light paths per pixel) that the sums hold.
    [[nodiscard]] std::int64_t sample_count() const { return counts_[0] + counts_[1]; }

    /// Adds one camera sample of pixel (x, y), which is in the region. Its camera samples come from
    /// one thread at a time, while others may add splats. The radiance is clamped unscaled, then
    /// weighted by `scale`, which differs from 1 if pixels take different numbers of samples.
    void add_sample(int x, int y, std::int64_t sample_index, Rgb radiance,
                    float scale = 1.0f) noexcept;
    /// Adds the contribution of a light path of sample `sample_index` at `raster` [pixels, origin
    /// at the top left]; ignored outside of the region, and by films without splats. Clamped and
    /// scaled as in `add_sample`. Safe from any thread.
    void add_splat(Vec2 raster, std::int64_t sample_index, Rgb radiance,
                   float scale = 1.0f) noexcept;
    /// Prefetches the memory that such a splat will change.
    void prefetch_splat(Vec2 raster, std::int64_t sample_index) noexcept;
    /// Records that the samples [begin, end) of every pixel have been added.
    void count_samples(std::int64_t begin, std::int64_t end);

    /// Adds another film of the same layout that holds other samples. Exact: the order of merging
    /// does not matter. Throws `Error` (usage) if layouts differ.
    void merge(const Film& other);

    /// Returns the estimate of radiance [nit] in the region: the sums divided by the number of
    /// samples.
    [[nodiscard]] Image develop() const;
    /// Returns the estimate from one half of the samples (0: even indices, 1: odd ones).
    [[nodiscard]] Image develop_half(int half) const;
    /// Returns the estimate from camera samples alone, of a film that adds splats apart.
    [[nodiscard]] Image develop_camera() const;
    /// Estimates the variance of `develop()` [nit^2], splats included, from the difference of the
    /// halves: with one degree of freedom per pixel, so very noisy in a single pixel. Unbiased if
    /// the halves are independent; 1.1 to 1.6 times as high in usual scenes after the number of
    /// samples that was planned (`SamplingOptions::planned_samples`). Infinite if a half is empty.
    [[nodiscard]] Image variance() const;
    [[nodiscard]] FilmDefects defects() const;
    [[nodiscard]] ClampLoss clamp_loss() const;

    // Access for files: the sums as planes, of which each row has one number per pixel.

    /// Returns "half0.R", ..., "half1.B". A plane sums camera samples and splats.
    [[nodiscard]] static std::vector<std::string> plane_names();
    /// Reads a row. `row` counts from the top of the region; `words` has the region's width.
    void read_row(std::size_t plane, int row, std::span<ExactSum::Words> words) const;
    void add_row(std::size_t plane, int row, std::span<const ExactSum::Words> words);
    [[nodiscard]] FilmTotals totals() const;
    void add_totals(const FilmTotals& totals);

    /// Tests for bit equality: sums, counts, defects and clamping loss.
    [[nodiscard]] bool operator==(const Film& other) const;

private:
    struct Pixel {
        std::array<ExactSum, 3> rgb;
        void add(Rgb value) noexcept;
        void add_alone(Rgb value) noexcept;
        void add(const Pixel& other) noexcept;
        [[nodiscard]] bool operator==(const Pixel&) const = default;
    };

    /// Clamping loss of a row of pixels, on cache lines of its own.
    struct RowLoss {
        Pixel light;
        ExactSum contributions;
        [[nodiscard]] bool operator==(const RowLoss&) const = default;
    };

    /// Returns the sum of camera samples and splats in one channel of a pixel.
    [[nodiscard]] ExactSum::Words sum(std::size_t half, std::size_t pixel,
                                      std::size_t channel) const noexcept;
    [[nodiscard]] Image develop(std::span<const std::size_t> halves) const;
    [[nodiscard]] Rgb clamp(Rgb value, int y, float scale) noexcept;
    [[nodiscard]] bool accept(Rgb& value, int x, int y, std::int64_t sample_index,
                              float scale) noexcept;
    [[nodiscard]] bool takes_splat(Vec2 raster) const noexcept;
    /// Returns the sum of splats at `raster`, a place that takes them.
    [[nodiscard]] Pixel& splats_at(Vec2 raster, std::int64_t sample_index) noexcept;

    FilmLayout layout_;
    std::array<std::int64_t, 2> counts_{};
    std::array<std::vector<Pixel>, 2> samples_;  // one per half
    std::array<std::vector<Pixel>, 2> splats_;   // one per half; empty unless they are apart
    std::vector<RowLoss> losses_;                // one per row; empty without a clamp
    std::atomic<std::uint64_t> invalid_{0};
    std::atomic<std::uint64_t> saturated_{0};
    std::atomic<std::uint64_t> first_invalid_{
        ~std::uint64_t{0}};  // sample index, then pixel of the image
};

}  // namespace bdpt
