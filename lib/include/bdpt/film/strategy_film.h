#pragma once

#include <bdpt/export.h>
#include <bdpt/film/exact_sum.h>
#include <bdpt/image.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace bdpt {

/// The contribution of one strategy to a pixel, divided by the number of its samples [nit].
struct StrategyShare {
    Rgb weighted{0.0f};    ///< its share by MIS
    Rgb unweighted{0.0f};  ///< as if it were the only one
};

/// "s02t03", as layers are named.
[[nodiscard]] BDPT_EXPORT std::string strategy_name(Strategy strategy);

/// Two images of each strategy: what it brings by itself, and its part of the image [Veach 1997,
/// fig. 10.3]. The sums are exact and without order like those of `Film`.
class BDPT_EXPORT StrategyFilm {
public:
    StrategyFilm() = default;
    /// `strategies` differ from each other.
    StrategyFilm(const PixelRect& region, std::span<const Strategy> strategies);

    /// Memory of one pixel of one strategy [bytes]: the sums, and the layers when they are
    /// developed.
    static constexpr std::uint64_t bytes_per_pixel = 6 * (sizeof(ExactSum) + sizeof(float));

    [[nodiscard]] const PixelRect& region() const { return region_; }
    /// In the order in which they were given.
    [[nodiscard]] const std::vector<Strategy>& strategies() const { return strategies_; }
    [[nodiscard]] bool empty() const { return strategies_.empty(); }

    /// Adds what `strategy` found for the pixel at `raster` [pixels of the whole image]. Ignored
    /// are strategies without images, places outside of the region, and values that are not finite
    /// or negative, which `Film` reports. Safe from any thread.
    void add(Strategy strategy, Vec2 raster, const StrategyShare& share) noexcept;
    /// States that `count` samples of every pixel have been added.
    void count_samples(std::int64_t count) { samples_ += count; }

    /// Adds the images of other samples. Throws `Error` (usage) when regions or strategies differ.
    void merge(const StrategyFilm& other);

    /// Radiance [nit] that the strategy, one of `strategies()`, finds by itself, and what of it is
    /// in the image.
    [[nodiscard]] Image unweighted(Strategy strategy) const;
    [[nodiscard]] Image weighted(Strategy strategy) const;
    /// All of them: layers "s02t03" (weighted) and "s02t03.unweighted" with RGB.
    [[nodiscard]] std::vector<Layer> develop() const;

    // For files, as those of `Film`: "s02t03.R", "s02t03.unweighted.R", ... of every strategy.
    [[nodiscard]] std::vector<std::string> plane_names() const;
    void read_row(std::size_t plane, int row, std::span<ExactSum::Words> words) const;
    void add_row(std::size_t plane, int row, std::span<const ExactSum::Words> words);

    /// Equal to the bit.
    [[nodiscard]] bool operator==(const StrategyFilm& other) const = default;

private:
    using Sum3 = std::array<ExactSum, 3>;
    struct Pixel {
        Sum3 weighted;
        Sum3 unweighted;
        [[nodiscard]] bool operator==(const Pixel&) const = default;
    };

    /// A plane's row in `pixels_`.
    struct PlaneRow {
        std::size_t first_pixel;
        Sum3 Pixel::*sums;
        std::size_t channel;
    };
    [[nodiscard]] PlaneRow place_of(std::size_t plane, int row) const;

    /// Where the images of a strategy begin in `pixels_`; the size of `pixels_` without any.
    [[nodiscard]] std::size_t begin_of(Strategy strategy) const noexcept;
    [[nodiscard]] Image develop(Strategy strategy, Sum3 Pixel::*sums) const;

    PixelRect region_;
    std::vector<Strategy> strategies_;
    int stride_ = 0;
    std::vector<std::size_t> begins_;  // by s * stride + t
    std::vector<Pixel> pixels_;        // of one strategy after the other
    std::int64_t samples_ = 0;
};

}  // namespace bdpt
