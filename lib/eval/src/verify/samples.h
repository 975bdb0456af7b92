#pragma once

#include <bdpt/path_contribution.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt::eval {

/// The scalar that represents a colour in a comparison of means.
enum class Measure : std::uint8_t { red, green, blue, mean };

/// Per-channel measures: a mistake may move light from one channel to another and preserve the
/// mean.
constexpr std::array<Measure, 3> channel_measures{Measure::red, Measure::green, Measure::blue};

[[nodiscard]] inline double measured(Measure measure, Rgb c)
{
    return measure == Measure::mean
               ? (static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b)) /
                     3.0
               : static_cast<double>(c[static_cast<int>(measure)]);
}

/// Returns the edges of a path; the two vertices of a merge count as one.
[[nodiscard]] inline int count_edges(const PathContribution& path)
{
    return path.strategy.s + path.strategy.t - (path.merged ? 2 : 1);
}

/// Sum of squares of observed or expected samples, binned by their size in steps of a factor of 4.
class SecondMoment {
public:
    /// Adds `moment`, the contribution of samples of `size` to the second moment; both are at least
    /// 0.
    void add(double size, double moment)
    {
        if (moment > 0.0) {
            sums_[bin(size)] += std::min(moment, most);
        }
    }
    SecondMoment& operator+=(const SecondMoment& other)
    {
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            sums_[i] += other.sums_[i];
        }
        return *this;
    }
    /// Returns the second moment of samples of at least this size; includes some that are smaller
    /// by a factor of up to 4.
    [[nodiscard]] double above(double size) const
    {
        double sum = 0.0;
        for (std::size_t i = bin(size); i < sums_.size(); ++i) {
            sum += sums_[i];
        }
        return sum;
    }

private:
    static constexpr double most = 1e150;  // greater than in any scene; sums of it are finite
    static constexpr int bins = 48;

    /// Returns the bin of a size from 4^-24 to 4^23 nit.
    static std::size_t bin(double size)
    {
        int exponent = 0;
        std::frexp(size, &exponent);
        return static_cast<std::size_t>(std::clamp((exponent + bins) / 2, 0, bins - 1));
    }

    std::array<double, bins> sums_{};
};

/// Russian roulette as configured by `verify`. Densities do not include it: survivors are rarer,
/// and each counts for more, than the shares of a path imply. So survival has a lower limit that
/// keeps each contribution at most `max_roulette_weight` times that without roulette, however dark
/// the scene is.
class Roulette {
public:
    /// Edges after which roulette may end a walk, the default of renders.
    static constexpr int start = 3;
    static constexpr double max_roulette_weight = 4.0;

    /// Computes the weights for paths of up to `max_depth` edges.
    explicit Roulette(int max_depth) : weights_(static_cast<std::size_t>(max_depth + 2), 1.0)
    {
        if (max_depth > start) {
            min_survival_ = std::pow(max_roulette_weight, -1.0 / (max_depth - start));
        }
        for (int vertices = 0; vertices < max_depth + 2; ++vertices) {
            weights_[static_cast<std::size_t>(vertices)] =
                std::pow(min_survival_, -std::max(0, vertices - 1 - start));
        }
    }

    /// Returns the value of `TransportOptions::rr_survival`.
    [[nodiscard]] float min_survival() const { return static_cast<float>(min_survival_); }

    /// Returns the greatest factor that roulette applies to contributions of `strategy`; 1 where it
    /// ends no walk. For paths of up to `max_depth` edges.
    [[nodiscard]] double max_weight(Strategy strategy) const
    {
        return weights_[static_cast<std::size_t>(strategy.s)] *
               weights_[static_cast<std::size_t>(strategy.t)];
    }

private:
    double min_survival_ = 1.0;    // per edge
    std::vector<double> weights_;  // maximum weight of a subpath, by its number of vertices
};

/// An image divided into `grid` x `grid` tiles of about equal size.
class TileGrid {
public:
    /// `grid` is at most the shorter side.
    TileGrid(int width, int height, int grid) : width_(width), height_(height), grid_(grid)
    {
        for (int row = 0; row < grid; ++row) {
            for (int column = 0; column < grid; ++column) {
                tiles_.push_back({.x0 = begin(column, width),
                                  .y0 = begin(row, height),
                                  .x1 = begin(column + 1, width),
                                  .y1 = begin(row + 1, height)});
            }
        }
    }

    /// Returns the tiles, row by row.
    [[nodiscard]] const std::vector<PixelRect>& tiles() const { return tiles_; }
    [[nodiscard]] std::size_t size() const { return tiles_.size(); }
    [[nodiscard]] double pixels() const
    {
        return static_cast<double>(width_) * static_cast<double>(height_);
    }
    [[nodiscard]] double pixels(std::size_t tile) const
    {
        return static_cast<double>(tiles_[tile].width()) *
               static_cast<double>(tiles_[tile].height());
    }

    /// Returns the tile of the pixel that holds `raster`, which is in the image.
    [[nodiscard]] std::size_t tile_at(Vec2 raster) const
    {
        return static_cast<std::size_t>(place(raster.y, height_) * grid_ + place(raster.x, width_));
    }

private:
    [[nodiscard]] int begin(int tile, int size) const
    {
        return static_cast<int>((static_cast<long long>(tile) * size + grid_ - 1) / grid_);
    }
    [[nodiscard]] int place(float raster, int size) const
    {
        const int pixel = std::clamp(static_cast<int>(raster), 0, size - 1);
        return static_cast<int>(static_cast<long long>(pixel) * grid_ / size);
    }

    int width_;
    int height_;
    int grid_;
    std::vector<PixelRect> tiles_;
};

}  // namespace bdpt::eval
