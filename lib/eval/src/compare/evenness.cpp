#include <bdpt/eval/evenness.h>

#include <bdpt/error.h>
#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "metrics/metric_parts.h"

namespace bdpt::eval {
namespace {

constexpr int noise_block_side = 8;    // [pixels]
constexpr int noise_block_stride = 4;  // [pixels]
constexpr int blocks_apart = noise_block_side / noise_block_stride;
constexpr double least_cosine = 0.984807753;  // of 10 degrees
constexpr float albedo_tolerance = 0.1f;
constexpr float whole_pixel = 0.999f;  // fraction of a pixel's rays that hit its object

/// The blocks of an image, row by row.
struct BlockGrid {
    int columns;
    int rows;

    BlockGrid(int width, int height)
        : columns(std::max(0, (width - noise_block_side) / noise_block_stride + 1)),
          rows(std::max(0, (height - noise_block_side) / noise_block_stride + 1))
    {}
    [[nodiscard]] std::size_t size() const
    {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
    [[nodiscard]] PixelRect rect(int column, int row) const
    {
        const int x = column * noise_block_stride;
        const int y = row * noise_block_stride;
        return {.x0 = x, .y0 = y, .x1 = x + noise_block_side, .y1 = y + noise_block_side};
    }
    [[nodiscard]] std::size_t index(int column, int row) const
    {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
    /// Calls `visit(x, y)` for each pixel of block `i`.
    template <typename Visit>
    void visit_pixels(std::size_t i, const Visit& visit) const
    {
        const int block = static_cast<int>(i);
        const PixelRect pixels = rect(block % columns, block / columns);
        for (int y = pixels.y0; y < pixels.y1; ++y) {
            for (int x = pixels.x0; x < pixels.x1; ++x) {
                visit(x, y);
            }
        }
    }
};

const Layer& layer_named(std::span<const Layer> layers, std::string_view name, const Image& image)
{
    const auto found = std::find_if(layers.begin(), layers.end(),
                                    [&](const Layer& layer) { return layer.name == name; });
    if (found == layers.end()) {
        throw Error(ErrorCode::invalid_input, "steps of noise need the layer " + std::string(name) +
                                                  " (AOVs albedo, normal and object)");
    }
    if (found->width != image.width || found->height != image.height) {
        throw Error(ErrorCode::invalid_input,
                    "the layer " + std::string(name) + " does not have the size of the images");
    }
    return *found;
}

Vec3 value_at(const Layer& layer, int x, int y)
{
    const std::size_t i = layer.channels.size() *
                          (static_cast<std::size_t>(y) * static_cast<std::size_t>(layer.width) +
                           static_cast<std::size_t>(x));
    return {layer.values[i], layer.values[i + 1], layer.values[i + 2]};
}

/// The surface that a block shows.
struct BlockSurface {
    std::optional<std::uint32_t> id{};  ///< none: more than one object, or none
    Vec3 normal{0.0f};                  ///< mean
    Vec3 albedo{0.0f};                  ///< mean
};

std::vector<BlockSurface> block_surfaces(const BlockGrid& grid, const Image& image,
                                         std::span<const Layer> layers)
{
    const Layer& ids = layer_named(layers, "CryptoObject00", image);
    const Layer& normals = layer_named(layers, "normal", image);
    const Layer& albedos = layer_named(layers, "albedo", image);
    std::vector<BlockSurface> result(grid.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        BlockSurface& surface = result[i];
        bool one = true;
        grid.visit_pixels(i, [&](int x, int y) {
            const Vec3 rank = value_at(ids, x, y);  // id, its fraction, the next id
            const auto id = std::bit_cast<std::uint32_t>(rank.x);
            one = one && rank.y >= whole_pixel && (!surface.id || *surface.id == id);
            surface.id = id;
            surface.normal += value_at(normals, x, y) / float(noise_block_side * noise_block_side);
            surface.albedo += value_at(albedos, x, y) / float(noise_block_side * noise_block_side);
        });
        if (!one) {
            surface.id.reset();
        }
    }
    return result;
}

bool are_alike(const BlockSurface& a, const BlockSurface& b)
{
    if (!a.id || a.id != b.id) {
        return false;
    }
    const double cosine = static_cast<double>(glm::dot(a.normal, b.normal));
    const double lengths =
        static_cast<double>(glm::length(a.normal)) * static_cast<double>(glm::length(b.normal));
    for (int c = 0; c < 3; ++c) {
        if (std::abs(a.albedo[c] - b.albedo[c]) >
            albedo_tolerance * std::max(a.albedo[c], b.albedo[c])) {
            return false;
        }
    }
    return cosine >= least_cosine * lengths;
}

/// Squared deviations from the mean of all seeds, summed over the pixels of each block: one list of
/// blocks for each seed.
std::vector<std::vector<double>> block_deviations(const BlockGrid& grid,
                                                  std::span<const Image> images)
{
    const auto width = static_cast<std::size_t>(images.front().width);
    std::vector<std::vector<double>> result(images.size(), std::vector<double>(grid.size()));
    std::vector<double> mean(images.front().pixels.size());
    const auto luminance_of = [](const Image& image, std::size_t i) {
        return static_cast<double>(glm::dot(image.pixels[i], Rgb(0.2126f, 0.7152f, 0.0722f)));
    };
    for (const Image& image : images) {
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] += luminance_of(image, i) / static_cast<double>(images.size());
        }
    }
    for (std::size_t seed = 0; seed < images.size(); ++seed) {
        for (std::size_t block = 0; block < grid.size(); ++block) {
            grid.visit_pixels(block, [&](int x, int y) {
                const std::size_t i =
                    static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
                const double deviation = luminance_of(images[seed], i) - mean[i];
                result[seed][block] += deviation * deviation;
            });
        }
    }
    return result;
}

/// The noise of blocks by some seeds, all but one or all.
class BlockNoise {
public:
    BlockNoise(const BlockGrid& grid, std::span<const Image> images)
        : deviations_(block_deviations(grid, images)), sums_(grid.size())
    {
        for (const std::vector<double>& seed : deviations_) {
            for (std::size_t block = 0; block < sums_.size(); ++block) {
                sums_[block] += seed[block];
            }
        }
    }
    [[nodiscard]] std::size_t seeds() const { return deviations_.size(); }
    /// Returns the logarithm of the noise, up to a constant; -infinity if there is none.
    [[nodiscard]] double log(std::size_t block) const { return 0.5 * std::log(sums_[block]); }
    [[nodiscard]] double log_without(std::size_t block, std::size_t seed) const
    {
        return 0.5 * std::log(std::max(0.0, sums_[block] - deviations_[seed][block]));
    }

private:
    std::vector<std::vector<double>> deviations_;
    std::vector<double> sums_;
};

/// Returns the step from block `a` to block `b`, without their places; none if one has no noise.
std::optional<NoiseStep> step_between(const BlockNoise& rated, const BlockNoise& even,
                                      std::size_t a, std::size_t b)
{
    const double step = rated.log(a) - rated.log(b) - even.log(a) + even.log(b);
    std::vector<double> parts;
    double mean = 0.0;
    const auto n = static_cast<double>(rated.seeds());
    for (std::size_t seed = 0; seed < rated.seeds(); ++seed) {
        parts.push_back(rated.log_without(a, seed) - rated.log_without(b, seed) -
                        even.log_without(a, seed) + even.log_without(b, seed));
        mean += parts.back() / n;
    }
    double squares = 0.0;
    for (const double part : parts) {
        squares += (part - mean) * (part - mean);
    }
    if (!std::isfinite(step) || !std::isfinite(squares)) {
        return std::nullopt;
    }
    return NoiseStep{.first = {},
                     .second = {},
                     .ratio = std::exp(std::abs(step)),
                     .standard_error = std::sqrt(squares * (n - 1.0) / n)};
}

void check_seeds(std::span<const Image> with_rates, std::span<const Image> even)
{
    constexpr std::size_t min_seeds = 3;
    if (with_rates.size() != even.size() || even.size() < min_seeds) {
        throw Error(ErrorCode::usage,
                    "steps of noise need equally many images with rates and without, at least " +
                        std::to_string(min_seeds) + " of each");
    }
    const NamedInput reference{.name = "the first image with rates", .image = with_rates.front()};
    check_image(reference);
    for (const std::span<const Image> images : {with_rates, even}) {
        for (const Image& image : images) {
            check_image({.name = "an image of another seed", .image = image}, reference);
        }
    }
}

}  // namespace

std::vector<NoiseStep> noise_steps(std::span<const Image> with_rates, std::span<const Image> even,
                                   std::span<const Layer> layers)
{
    check_seeds(with_rates, even);
    const Image& image = with_rates.front();
    const BlockGrid grid(image.width, image.height);
    const std::vector<BlockSurface> surfaces = block_surfaces(grid, image, layers);
    const BlockNoise rated_noise(grid, with_rates);
    const BlockNoise even_noise(grid, even);
    std::vector<NoiseStep> steps;
    constexpr std::array<std::array<int, 2>, 2> directions{{{blocks_apart, 0}, {0, blocks_apart}}};
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            for (const auto& [right, down] : directions) {
                if (column + right >= grid.columns || row + down >= grid.rows) {
                    continue;
                }
                const std::size_t a = grid.index(column, row);
                const std::size_t b = grid.index(column + right, row + down);
                if (!are_alike(surfaces[a], surfaces[b])) {
                    continue;
                }
                if (auto step = step_between(rated_noise, even_noise, a, b)) {
                    step->first = grid.rect(column, row);
                    step->second = grid.rect(column + right, row + down);
                    steps.push_back(*step);
                }
            }
        }
    }
    std::stable_sort(steps.begin(), steps.end(),
                     [](const NoiseStep& a, const NoiseStep& b) { return a.least() > b.least(); });
    return steps;
}

}  // namespace bdpt::eval
