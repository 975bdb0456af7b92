#pragma once

#include <bdpt/export.h>
#include <bdpt/image.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// A sum of floats that does not depend on their order: a 128-bit fixed-point number made of two
/// atomic words, the low one with unit 2^-60. A carry out of the low word is added to the high one;
/// both additions commute, so any interleaving of threads gives the same bits.
class BDPT_EXPORT ExactSum {
public:
    /// Largest magnitude that is added as it is; greater ones count as this one.
    static constexpr float max_value = 8.796093e12f;  // 2^43

    ExactSum() = default;
    ExactSum(const ExactSum& other) noexcept { *this = other; }
    ExactSum& operator=(const ExactSum& other) noexcept;

    /// `value` is finite, not negative and at most `max_value`. Safe from any thread.
    void add(float value) noexcept;
    /// Not safe while other threads add.
    void add(const ExactSum& other) noexcept;
    [[nodiscard]] double value() const noexcept;
    [[nodiscard]] bool operator==(const ExactSum& other) const noexcept;

private:
    void add_words(std::uint64_t low, std::uint64_t high) noexcept;

    std::atomic<std::uint64_t> low_{0};
    std::atomic<std::uint64_t> high_{0};
};

/// Contributions that could not be added as they were. All zero after a sound render.
struct FilmDefects {
    std::uint64_t invalid = 0;    ///< NaN, infinite or negative: dropped
    std::uint64_t saturated = 0;  ///< above ExactSum::max_value: added as that

    struct Place {
        int x = 0;
        int y = 0;
        std::int64_t sample_index = 0;
        [[nodiscard]] bool operator==(const Place&) const = default;
    };
    /// The pixel sample with the lowest index (then row, then column) that gave an invalid value.
    std::optional<Place> first_invalid;
};

/// What a render measured: for each pixel the sum of its own camera samples and the sum of what
/// light paths splatted on it, each in two independent halves (even and odd sample index). The
/// pixel filter is a box one pixel wide. Pixel (0, 0) is at the top left.
class BDPT_EXPORT Film {
public:
    Film() = default;
    /// `width`, `height` > 0. Without splats the light image takes no memory.
    Film(int width, int height, bool splats);
    Film(Film&&) noexcept;
    Film& operator=(Film&&) noexcept;

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// Samples a pixel (and light paths a pixel) that the sums hold.
    [[nodiscard]] std::int64_t sample_count() const { return counts_[0] + counts_[1]; }

    /// Adds one camera sample of pixel (x, y). Safe from any thread.
    void add_sample(int x, int y, std::int64_t sample_index, Rgb radiance) noexcept;
    /// Adds what a light path of sample `sample_index` brings to `raster` [pixels, origin at the
    /// top left]; outside of the film it is ignored. Safe from any thread.
    void add_splat(Vec2 raster, std::int64_t sample_index, Rgb radiance) noexcept;
    /// States that the samples [begin, end) of every pixel have been added.
    void count_samples(std::int64_t begin, std::int64_t end);

    /// Adds another film of the same size that holds other samples. Exact: the order of merging
    /// does not matter. Throws `Error` (usage) when sizes differ.
    void merge(const Film& other);

    /// The estimate of radiance [nit]: the sums divided by the number of samples.
    [[nodiscard]] Image develop() const;
    /// The estimate from one half of the samples (0: even indices, 1: odd ones).
    [[nodiscard]] Image develop_half(int half) const;
    [[nodiscard]] FilmDefects defects() const;
    /// Equal to the bit: sums, counts and defects.
    [[nodiscard]] bool operator==(const Film& other) const;

private:
    struct Pixel {
        std::array<ExactSum, 3> rgb;
        void add(Rgb value) noexcept;
        [[nodiscard]] bool operator==(const Pixel&) const = default;
    };

    [[nodiscard]] Image develop(std::span<const std::size_t> halves) const;
    [[nodiscard]] bool accept(Rgb& value, int x, int y, std::int64_t sample_index) noexcept;
    [[nodiscard]] std::size_t index(int x, int y) const;

    int width_ = 0;
    int height_ = 0;
    std::array<std::int64_t, 2> counts_{};
    std::array<std::vector<Pixel>, 2> samples_;  // by half
    std::array<std::vector<Pixel>, 2> splats_;   // by half; empty without splats
    std::atomic<std::uint64_t> invalid_{0};
    std::atomic<std::uint64_t> saturated_{0};
    std::atomic<std::uint64_t> first_invalid_{~std::uint64_t{0}};  // sample index, pixel index
};

}  // namespace bdpt
