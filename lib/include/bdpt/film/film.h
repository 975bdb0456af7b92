#pragma once

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

/// Contributions that could not be added as they were. All zero after a sound render.
struct FilmDefects {
    std::uint64_t invalid = 0;    ///< NaN, infinite or negative: dropped
    std::uint64_t saturated = 0;  ///< above ExactSum::max_value: added as that

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

/// Whether a film takes contributions of light paths to any pixel.
enum class SplatImage : std::uint8_t { absent, present };

/// The size and the buffers of a film.
struct FilmLayout {
    int width = 0;  ///< of the whole image [pixels]
    int height = 0;
    PixelRect region;  ///< the part of it that the film holds: not empty, inside
    SplatImage splats = SplatImage::present;  ///< absent takes half the memory
    /// The greatest component [nit] that one contribution may have; greater ones are scaled down.
    float clamp = std::numeric_limits<float>::infinity();
    [[nodiscard]] bool operator==(const FilmLayout&) const = default;
};

/// The totals of a film that files keep beside the sums of its pixels.
struct FilmTotals {
    FilmDefects defects;
    std::array<ExactSum::Words, 3> clamped{};  ///< radiance that clamping took, summed up
    ExactSum::Words clamped_contributions{};
};

/// The radiance that clamping removed from the estimate.
struct ClampLoss {
    std::uint64_t contributions = 0;  ///< that were scaled down
    Rgb radiance{0.0f};               ///< on average over the pixels of the region [nit]
};

/// The sums of a render: for each pixel the sum of its own camera samples and the sum of the splats
/// of light paths, each in two independent halves (even and odd sample index). All positions are
/// those of the whole image, also when the film holds only a part of it.
class BDPT_EXPORT Film {
public:
    Film() = default;
    explicit Film(const FilmLayout& layout);
    Film(Film&&) noexcept;
    Film& operator=(Film&&) noexcept;

    [[nodiscard]] const FilmLayout& layout() const { return layout_; }
    [[nodiscard]] const PixelRect& region() const { return layout_.region; }
    /// The size of the film's region [pixels].
    [[nodiscard]] int width() const { return region().width(); }
    [[nodiscard]] int height() const { return region().height(); }
    /// Samples a pixel (and light paths a pixel) that the sums hold.
    [[nodiscard]] std::int64_t sample_count() const { return counts_[0] + counts_[1]; }

    /// Adds one camera sample of pixel (x, y), which is in the region. Each pixel belongs to one
    /// thread at a time. It is clamped as it is, and then counts `scale` times: more or less than
    /// once, if pixels take different numbers of samples.
    void add_sample(int x, int y, std::int64_t sample_index, Rgb radiance,
                    float scale = 1.0f) noexcept;
    /// Adds what a light path of sample `sample_index` brings to `raster` [pixels, origin at the
    /// top left]; outside of the region it is ignored. Clamped and scaled likewise. Safe from any
    /// thread.
    void add_splat(Vec2 raster, std::int64_t sample_index, Rgb radiance,
                   float scale = 1.0f) noexcept;
    /// Fetches what such a splat will change from memory, to be there when it comes.
    void prefetch_splat(Vec2 raster, std::int64_t sample_index) const noexcept;
    /// States that the samples [begin, end) of every pixel have been added.
    void count_samples(std::int64_t begin, std::int64_t end);

    /// Adds another film of the same layout that holds other samples. Exact: the order of merging
    /// does not matter. Throws `Error` (usage) when layouts differ.
    void merge(const Film& other);

    /// The estimate of radiance [nit] in the region: the sums divided by the number of samples.
    [[nodiscard]] Image develop() const;
    /// The estimate from one half of the samples (0: even indices, 1: odd ones).
    [[nodiscard]] Image develop_half(int half) const;
    /// The same as `develop()` of camera samples alone, without what was splatted. Only of what
    /// this film was given one by one: in files both are one sum.
    [[nodiscard]] Image develop_camera() const;
    /// Estimate of the variance of `develop()` [nit^2], splats included, from the difference of the
    /// halves: unbiased but with one degree of freedom a pixel, so very noisy in a single one.
    /// Infinite when a half is empty.
    [[nodiscard]] Image variance() const;
    [[nodiscard]] FilmDefects defects() const;
    [[nodiscard]] ClampLoss clamp_loss() const;

    // For files: the sums as planes, of which each row has a number a pixel.

    /// "half0.R", ..., "half1.B". A plane has camera samples and splats in one: no image tells them
    /// apart.
    [[nodiscard]] static std::vector<std::string> plane_names();
    /// `row` counts from the top of the region; `words` is as long as the region is wide.
    void read_row(std::size_t plane, int row, std::span<ExactSum::Words> words) const;
    void add_row(std::size_t plane, int row, std::span<const ExactSum::Words> words);
    [[nodiscard]] FilmTotals totals() const;
    void add_totals(const FilmTotals& totals);

    /// Equal to the bit: sums, counts, defects and what was clamped.
    [[nodiscard]] bool operator==(const Film& other) const;

private:
    struct Pixel {
        std::array<ExactSum, 3> rgb;
        void add(Rgb value) noexcept;
        void add_alone(Rgb value) noexcept;
        void add(const Pixel& other) noexcept;
        [[nodiscard]] bool operator==(const Pixel&) const = default;
    };

    /// The loss by clamping in a row of pixels, on cache lines of its own.
    struct RowLoss {
        Pixel light;
        ExactSum contributions;
        [[nodiscard]] bool operator==(const RowLoss&) const = default;
    };

    /// Camera samples and splats of a channel of a pixel.
    [[nodiscard]] ExactSum::Words sum(std::size_t half, std::size_t pixel,
                                      std::size_t channel) const noexcept;
    [[nodiscard]] Image develop(std::span<const std::size_t> halves) const;
    [[nodiscard]] Rgb clamp(Rgb value, int y, float scale) noexcept;
    [[nodiscard]] bool accept(Rgb& value, int x, int y, std::int64_t sample_index,
                              float scale) noexcept;
    [[nodiscard]] bool holds(Vec2 raster) const noexcept;
    [[nodiscard]] std::size_t index(int x, int y) const;

    FilmLayout layout_;
    std::array<std::int64_t, 2> counts_{};
    std::array<std::vector<Pixel>, 2> samples_;  // by half
    std::array<std::vector<Pixel>, 2> splats_;   // by half; empty without splats
    std::vector<RowLoss> losses_;                // by row; empty without a clamp
    std::atomic<std::uint64_t> invalid_{0};
    std::atomic<std::uint64_t> saturated_{0};
    std::atomic<std::uint64_t> first_invalid_{
        ~std::uint64_t{0}};  // sample index, pixel of the image
};

}  // namespace bdpt
