#include <bdpt/noise.h>

#include "math/rgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace bdpt {
namespace {

constexpr int tile_side = 16;            // approximately [pixels]
constexpr double share_of_tiles = 0.95;  // fraction of tiles at or below the noise
constexpr double clean = 1e-4;           // errors below count only where all are
constexpr double dark = 0.01;            // relative to the image's mean luminance
constexpr std::int64_t first_look = 16;
constexpr std::int64_t max_samples = std::int64_t{1} << 31;

/// Returns the begins of the tiles of `length` pixels, and the end: none is much smaller than the
/// others.
std::vector<int> borders(int length)
{
    const int tiles = std::max(1, (length + tile_side / 2) / tile_side);
    std::vector<int> result;
    for (std::int64_t i = 0; i <= tiles; ++i) {
        result.push_back(static_cast<int>(i * length / tiles));
    }
    return result;
}

/// Sums over pixels.
struct NoiseSums {
    double luminance = 0.0;
    double empty = 0.0;     ///< of 1 - coverage
    double variance = 0.0;  ///< of the mean of both halves
    double pixels = 0.0;

    /// Returns the brightness before a background of that brightness.
    [[nodiscard]] double brightness(double background) const
    {
        return (luminance + empty * background) / pixels;
    }
};

struct NoiseTile {
    NoiseSums all;
    NoiseSums certain;  ///< of pixels that are covered in all samples, or in none
};

/// Measures the tiles between two boundaries of rows. `coverage` is empty if all is opaque.
void measure_row_of_tiles(const Image& even, const Image& odd, std::span<const float> coverage,
                          int top, int bottom, const std::vector<int>& columns, NoiseTile* tiles)
{
    for (int y = top; y < bottom; ++y) {
        for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
            for (int x = columns[i]; x < columns[i + 1]; ++x) {
                const auto a = static_cast<double>(luminance(even.at(x, y)));
                const auto b = static_cast<double>(luminance(odd.at(x, y)));
                const auto pixel =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(even.width) +
                    static_cast<std::size_t>(x);
                const double empty =
                    coverage.empty() ? 0.0 : 1.0 - static_cast<double>(coverage[pixel]);
                const auto add = [&](NoiseSums& sums) {
                    sums.luminance += 0.5 * (a + b);
                    sums.empty += empty;
                    sums.variance += 0.25 * (a - b) * (a - b);
                    sums.pixels += 1.0;
                };
                add(tiles[i].all);
                if (empty == 0.0 || empty == 1.0) {
                    add(tiles[i].certain);
                }
            }
        }
    }
}

}  // namespace

double estimate_noise(const Film& film, const AovFilm& aovs)
{
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (film.sample_count() < 2) {
        return unknown;
    }
    const Image even = film.develop_half(0);
    const Image odd = film.develop_half(1);
    const std::vector<int> rows = borders(film.height());
    const std::vector<int> columns = borders(film.width());
    const std::size_t across = columns.size() - 1;
    const std::vector<float> coverage = aovs.coverage(film);
    std::vector<NoiseTile> tiles((rows.size() - 1) * across);
    tbb::parallel_for(std::size_t{0}, rows.size() - 1, [&](std::size_t i) {
        measure_row_of_tiles(even, odd, coverage, rows[i], rows[i + 1], columns,
                             &tiles[i * across]);
    });
    double light = 0.0;
    double opaque = 0.0;
    for (const NoiseTile& tile : tiles) {
        light += tile.all.luminance;
        opaque += tile.all.pixels - tile.all.empty;
    }
    if (!(light > 0.0 && opaque > 0.0)) {
        return unknown;
    }
    const double mean = light / opaque;  // of the image, and of what lies behind it
    std::vector<double> errors;
    for (const NoiseTile& tile : tiles) {
        // Before a background of that brightness, the border of a silhouette is as clean as the
        // rest of it. Where all is partly covered, such as hair, it counts.
        const NoiseSums& sums = tile.certain.pixels > tile.certain.empty ? tile.certain : tile.all;
        if (sums.variance > 0.0) {
            errors.push_back(std::sqrt(sums.variance / sums.pixels) /
                             std::max(sums.brightness(mean), dark * mean));
        }
    }
    if (errors.empty()) {
        return 0.0;
    }
    std::sort(errors.begin(), errors.end());
    const double least = errors.back() < clean ? 0.0 : clean;
    const auto first = std::lower_bound(errors.begin(), errors.end(), least);
    const auto rank = static_cast<std::ptrdiff_t>(
        std::ceil(share_of_tiles * static_cast<double>(errors.end() - first)));
    return first[rank - 1];
}

std::int64_t next_noise_look(std::int64_t samples)
{
    std::int64_t look = first_look;
    while (look <= samples) {
        // 2^k is followed by 3 * 2^(k - 1), and that by 2^(k + 1).
        const bool power_of_two = (look & (look - 1)) == 0;
        look += power_of_two ? look / 2 : look / 3;
    }
    return look;
}

bool is_noise_look(std::int64_t samples)
{
    return samples >= first_look && next_noise_look(samples - 1) == samples;
}

std::int64_t samples_for_noise(double noise, std::int64_t samples, double goal)
{
    const double ratio = noise / goal;
    const double wanted = static_cast<double>(samples) * ratio * ratio;
    if (!(wanted < static_cast<double>(max_samples))) {
        return max_samples;
    }
    return next_noise_look(static_cast<std::int64_t>(std::ceil(wanted)) - 1);
}

}  // namespace bdpt
