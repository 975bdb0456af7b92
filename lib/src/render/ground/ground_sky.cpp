#include "render/ground/ground_sky.h"

#include "math/elementary.h"
#include "math/rgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

constexpr float below_one = 0x1.fffffep-1f;

/// Returns the unit direction of an azimuth, measured as in `GroundOccluders`, and a polar angle.
Vec3 to_direction(float azimuth, float sine, float cosine)
{
    constexpr float radians = 2.0f * pi / static_cast<float>(GroundOccluders::strips);
    const SinCos phi = sin_cos(radians * azimuth);
    return {sine * phi.sin, cosine, sine * phi.cos};
}

GroundSky::Effort choose_effort(const GroundSky::Shares& shares)
{
    if (!(shares.exposed > 0.0f)) {
        return {};
    }
    constexpr float samples_of_all = 4.0f;  // samples if all of the sky may be blocked
    const float wanted = samples_of_all * shares.exposed / (shares.open + shares.exposed);
    const auto samples = static_cast<std::uint32_t>(std::ceil(wanted));
    const float chance = std::min(wanted, 1.0f);
    return {.samples = samples,
            .chance = chance,
            .weight = 1.0f / (chance * static_cast<float>(samples))};
}

/// Counts how many of the first `n` ascending numbers are at most `x`, without branches that the
/// processor has to predict. `n` is less than a power of two, `2 * half`.
template <typename Number>
std::size_t count_up_to(const Number* numbers, std::size_t n, Number x, std::size_t half)
{
    std::size_t count = 0;
    for (std::size_t step = half; step > 0; step /= 2) {
        const std::size_t next = count + step;
        const bool is_up_to = numbers[std::min(next, std::max<std::size_t>(n, 1)) - 1] <= x;
        count = (next <= n && is_up_to) ? next : count;
    }
    return count;
}

template <std::size_t count>
double compute_sum(const std::array<float, count>& numbers)
{
    double sum = 0.0;
    for (const float number : numbers) {
        sum += static_cast<double>(number);
    }
    return sum;
}

}  // namespace

GroundSky::GroundSky(const EnvironmentLight& sky, const GroundOccluders& occluders)
    : sky_(sky),
      occluders_(occluders),
      cells_(strips * rows),
      weights_(strips),
      irradiances_(strips)
{
    for (std::size_t row = 0; row <= rows; ++row) {
        const float sine =
            sin_cos(0.5f * pi * static_cast<float>(row) / static_cast<float>(rows)).sin;
        sines_squared_[row] = row == rows ? 1.0f : sine * sine;
    }
    for (std::size_t row = 0; row < rows; ++row) {
        projected_[row] = pi / static_cast<float>(columns) *
                          (sines_squared_[row + 1] - sines_squared_[row]);
    }
    fill_cells();
    double all = 0.0;
    for (const RowSums& strip : irradiances_) {
        all += strip.back();
    }
    irradiance_ = static_cast<float>(all);
    places_.resize(occluders.place_count());
    tbb::parallel_for(std::size_t{0}, places_.size(), [&](std::size_t i) {
        Place& place = places_[i];
        const GroundOccluders::Skyline& skyline = occluders_.skyline(i);
        double exposed = 0.0;
        double weight = 0.0;
        for (std::size_t strip = 0; strip < strips; ++strip) {
            const GroundOccluders::Rows blocked = skyline[strip];
            exposed += irradiances_[strip][blocked.end] - irradiances_[strip][blocked.begin];
            weight += weights_[strip][blocked.end] - weights_[strip][blocked.begin];
            place.weights[strip] = static_cast<float>(weight);
        }
        place.weight = place.weights.back();
        place.shares = {.open = static_cast<float>(std::max(all - exposed, 0.0)),
                        .exposed = place.weight > 0.0f ? static_cast<float>(exposed) : 0.0f};
        place.effort = choose_effort(place.shares);
    });
}

/// Evaluates each cell at a grid of points that are at most a texel apart. With bilinear
/// interpolation, uniform grids are exact in the interior: a texel's weights at points one texel
/// apart add up to one, wherever the points are.
void GroundSky::fill_cells()
{
    const int max_points = 16;
    const auto points = [max_points](int texels, int cells) {
        return std::clamp((texels + cells - 1) / cells, 2, max_points);
    };
    const int across = points(sky_.width(), static_cast<int>(columns));
    const int along = points(sky_.height(), 2 * static_cast<int>(rows));
    std::vector<std::array<float, rows>> means(columns);
    tbb::parallel_for(std::size_t{0}, columns, [&](std::size_t column) {
        for (std::size_t row = 0; row < rows; ++row) {
            double sum = 0.0;
            for (int j = 0; j < along; ++j) {
                const float y = static_cast<float>(row) +
                                (static_cast<float>(j) + 0.5f) / static_cast<float>(along);
                const SinCos theta = sin_cos(0.5f * pi * y / static_cast<float>(rows));
                const double size = static_cast<double>(theta.sin * theta.cos);
                for (int i = 0; i < across; ++i) {
                    const float x = static_cast<float>(column) +
                                    (static_cast<float>(i) + 0.5f) / static_cast<float>(across);
                    const Vec3 to_light = to_direction(x / static_cast<float>(columns_of_strip),
                                                       theta.sin, theta.cos);
                    sum += size * static_cast<double>(luminance(sky_.radiance(to_light)));
                }
            }
            constexpr double solid_angle =
                2.0 * static_cast<double>(pi) / columns * 0.5 * static_cast<double>(pi) / rows;
            means[column][row] =
                static_cast<float>(sum * solid_angle / static_cast<double>(across * along));
        }
    });
    // A cell whose points are all dark may have light between them if its neighbours do.
    constexpr float min_share = 0.01f;
    tbb::parallel_for(std::size_t{0}, columns, [&](std::size_t column) {
        for (std::size_t row = 0; row < rows; ++row) {
            float most = 0.0f;
            for (const std::size_t x :
                 {column, (column + 1) % columns, (column + columns - 1) % columns}) {
                for (std::size_t y = row - std::min<std::size_t>(row, 1);
                     y <= std::min(row + 1, rows - 1); ++y) {
                    most = std::max(most, means[x][y]);
                }
            }
            cells(column / columns_of_strip, row)[column % columns_of_strip] =
                std::max(means[column][row], min_share * most);
        }
    });
    for (std::size_t strip = 0; strip < strips; ++strip) {
        RowSums& sums = weights_[strip];
        for (std::size_t row = 0; row < rows; ++row) {
            sums[row + 1] = sums[row] + compute_sum(cells(strip, row));
        }
    }
    for (std::size_t column = 0; column < columns; ++column) {
        RowSums& strip = irradiances_[column / columns_of_strip];
        double above = 0.0;
        for (std::size_t row = 0; row < rows; ++row) {
            above += static_cast<double>(means[column][row]);
            strip[row + 1] += above;
        }
    }
}

GroundSky::Sample GroundSky::sample(std::size_t place, Vec2 u) const
{
    const Place& from = places_[place];
    constexpr Sample nothing{.to_light = {0.0f, 1.0f, 0.0f}};
    // A strip of those that may be blocked, by the first number.
    const float target = std::min(u.x, below_one) * from.weight;
    const std::size_t strip = count_up_to(from.weights.data(), strips - 1, target, strips / 2);
    const GroundOccluders::Rows blocked = occluders_.skyline(place)[strip];
    // A row of it, by the second.
    const RowSums& sums = weights_[strip];
    const double weight = sums[blocked.end] - sums[blocked.begin];
    if (!(weight > 0.0)) {
        return nothing;
    }
    const double height = sums[blocked.begin] + static_cast<double>(u.y) * weight;
    const std::size_t row =
        blocked.begin + count_up_to(sums.data() + blocked.begin + 1,
                                    std::size_t{blocked.end} - blocked.begin - 1U, height, rows / 2);
    const auto of_row = static_cast<float>(sums[row + 1] - sums[row]);
    if (!(of_row > 0.0f)) {
        return nothing;
    }
    const float along =
        std::min(std::max(static_cast<float>(height - sums[row]), 0.0f) / of_row, below_one);
    // A cell of both, by what is left of the first.
    const Cells& row_of_cells = cells(strip, row);
    const float before = strip > 0 ? from.weights[strip - 1] : 0.0f;
    float left = (target - before) / static_cast<float>(weight) * of_row;
    std::size_t cell = 0;
    while (cell + 1 < columns_of_strip && left >= row_of_cells[cell]) {
        left -= row_of_cells[cell];
        ++cell;
    }
    const float of_cell = row_of_cells[cell];
    if (!(of_cell > 0.0f)) {
        return nothing;
    }
    const float over_cell = 1.0f / of_cell;
    const float across = std::min(left * over_cell, below_one);
    const std::size_t column = strip * columns_of_strip + cell;
    // In a cell all of the projected solid angle is the same.
    const float sine_squared =
        sines_squared_[row] + along * (sines_squared_[row + 1] - sines_squared_[row]);
    const float azimuth =
        (static_cast<float>(column) + across) / static_cast<float>(columns_of_strip);
    const Vec3 to_light = to_direction(azimuth, std::sqrt(sine_squared),
                                       std::sqrt(std::max(1.0f - sine_squared, 0.0f)));
    const float over_density = from.weight * over_cell * projected_[row];
    return {.to_light = to_light, .irradiance = over_density * sky_.radiance(to_light)};
}

}  // namespace bdpt
