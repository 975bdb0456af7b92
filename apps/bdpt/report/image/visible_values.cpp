#include "report/image/visible_values.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace bdpt::app {
namespace {

/// Values times shares, and shares.
struct Level {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<float> sums;
    std::vector<float> shares;
};

/// Returns the next coarser level: means of two by two pixels.
Level pulled(const Level& fine, std::size_t channels)
{
    Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}};
    const std::size_t pixels = coarse.width * coarse.height;
    coarse.sums.resize(pixels * channels);
    coarse.shares.resize(pixels);
    for (std::size_t y = 0; y < fine.height; ++y) {
        for (std::size_t x = 0; x < fine.width; ++x) {
            const std::size_t from = y * fine.width + x;
            const std::size_t to = (y / 2) * coarse.width + x / 2;
            coarse.shares[to] += 0.25f * fine.shares[from];
            for (std::size_t c = 0; c < channels; ++c) {
                coarse.sums[to * channels + c] += 0.25f * fine.sums[from * channels + c];
            }
        }
    }
    return coarse;
}

/// Returns the values of a level; pixels that show nothing get those of the coarser one.
std::vector<float> pushed(const Level& fine, const std::vector<float>& coarse, std::size_t channels)
{
    std::vector<float> values(fine.sums.size());
    const std::size_t coarse_width = (fine.width + 1) / 2;
    for (std::size_t i = 0; i < fine.shares.size(); ++i) {
        const std::size_t parent = (i / fine.width / 2) * coarse_width + (i % fine.width) / 2;
        for (std::size_t c = 0; c < channels; ++c) {
            // Mixing both would bleed a bright neighbour into the dark pixels of an edge.
            values[i * channels + c] = fine.shares[i] > 0.0f
                                           ? fine.sums[i * channels + c] / fine.shares[i]
                                           : coarse[parent * channels + c];
        }
    }
    return values;
}

}  // namespace

Layer visible_values(const Layer& layer, std::span<const float> shares)
{
    const std::size_t channels = layer.channels.size();
    std::vector<Level> levels;
    levels.push_back({static_cast<std::size_t>(layer.width),
                      static_cast<std::size_t>(layer.height),
                      layer.values,
                      {shares.begin(), shares.end()}});
    while (levels.back().shares.size() > 1) {
        levels.push_back(pulled(levels.back(), channels));
    }
    std::vector<float> values(channels, 0.0f);
    for (std::size_t level = levels.size(); level-- > 0;) {
        values = pushed(levels[level], values, channels);
    }
    Layer result = layer;
    result.values = std::move(values);
    return result;
}

}  // namespace bdpt::app
