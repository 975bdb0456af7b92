#pragma once

/// @file
/// Holds the images of strategies: what each finds by itself, and its part of the image.
///
/// @code{.cpp}
/// void write_strategies(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     const bdpt::RenderOptions options = {.integrator = bdpt::IntegratorKind::bdpt,
///                                          .bidirectional = {.strategy_depth = 5}};
///     const bdpt::RenderResult result = bdpt::render(scene, camera, options);
///     const std::vector<bdpt::Layer> layers = result.strategies.develop();
///     bdpt::io::write_exr("strategies.exr", result.image(), layers, {});
/// }
/// @endcode

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

/// The contribution of one strategy to a pixel, divided by its number of samples [nit].
struct StrategyShare {
    Rgb weighted{0.0f};    ///< with its MIS weight
    Rgb unweighted{0.0f};  ///< as if it were the only strategy
};

/// Returns the name of a strategy's layer: "s02t03".
[[nodiscard]] BDPT_EXPORT std::string strategy_name(Strategy strategy);

/// Two images for each strategy: unweighted, and weighted as in the final image [Veach 1997, fig.
/// 10.3]. The sums are exact and independent of order, like those of `Film`.
class BDPT_EXPORT StrategyFilm {
public:
    StrategyFilm() = default;
    /// `strategies` must be distinct.
    StrategyFilm(const PixelRect& region, std::span<const Strategy> strategies);

    /// Memory per pixel and strategy [bytes]: the sums, and the layers once they are developed.
    static constexpr std::uint64_t bytes_per_pixel = 6 * (sizeof(ExactSum) + sizeof(float));

    [[nodiscard]] const PixelRect& region() const { return region_; }
    /// Returns the strategies in the order in which they were given.
    [[nodiscard]] const std::vector<Strategy>& strategies() const { return strategies_; }
    [[nodiscard]] bool empty() const { return strategies_.empty(); }

    /// Adds the contribution of `strategy` to the pixel at `raster` [pixels of the whole image].
    /// Ignores strategies without images, positions outside of the region, and values that are
    /// negative or not finite, which `Film` reports. Safe from any thread.
    void add(Strategy strategy, Vec2 raster, const StrategyShare& share) noexcept;
    /// Records that `count` samples of every pixel have been added.
    void count_samples(std::int64_t count) { samples_ += count; }

    /// Adds the images of other samples. Throws `Error` (usage) if regions or strategies differ.
    void merge(const StrategyFilm& other);

    /// Returns the radiance [nit] that `strategy`, one of `strategies()`, estimates by itself
    /// (unweighted), or contributes to the image (weighted).
    [[nodiscard]] Image unweighted(Strategy strategy) const;
    [[nodiscard]] Image weighted(Strategy strategy) const;
    /// Returns all images: layers "s02t03" (weighted) and "s02t03.unweighted" with RGB.
    [[nodiscard]] std::vector<Layer> develop() const;

    // Access for files, as in `Film`: "s02t03.R", "s02t03.unweighted.R", ... of every strategy.
    [[nodiscard]] std::vector<std::string> plane_names() const;
    void read_row(std::size_t plane, int row, std::span<ExactSum::Words> words) const;
    void add_row(std::size_t plane, int row, std::span<const ExactSum::Words> words);

    /// Tests for bit equality.
    [[nodiscard]] bool operator==(const StrategyFilm& other) const = default;

private:
    using Sum3 = std::array<ExactSum, 3>;
    struct Pixel {
        Sum3 weighted;
        Sum3 unweighted;
        [[nodiscard]] bool operator==(const Pixel&) const = default;
    };

    /// The location of a plane's row in `pixels_`.
    struct PlaneRow {
        std::size_t first_pixel;
        Sum3 Pixel::*sums;
        std::size_t channel;
    };
    [[nodiscard]] PlaneRow plane_row(std::size_t plane, int row) const;

    /// Returns the index in `pixels_` where the images of a strategy begin; the size of `pixels_`
    /// if it has none.
    [[nodiscard]] std::size_t find_begin(Strategy strategy) const noexcept;
    [[nodiscard]] Image develop(Strategy strategy, Sum3 Pixel::*sums) const;

    PixelRect region_;
    std::vector<Strategy> strategies_;
    int stride_ = 0;
    std::vector<std::size_t> begins_;  // indexed by s * stride + t
    std::vector<Pixel> pixels_;        // one strategy after the other
    std::int64_t samples_ = 0;
};

}  // namespace bdpt
