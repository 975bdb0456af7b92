#include "render/ground/ground_light.h"

#include "math/elementary.h"
#include "math/random_numbers.h"
#include "math/rgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bdpt {
namespace {

constexpr float below_one = 0x1.fffffep-1f;
constexpr std::uint32_t cell_units = 255;  // cells of a row add up to it

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
    constexpr float samples_of_all = 3.0f;  // samples if all of the sky may be blocked
    const float wanted = samples_of_all * shares.exposed / (shares.open + shares.exposed);
    constexpr float most = 2.0f;  // more cost more than they help where the scene blocks most
    const auto samples = static_cast<std::uint32_t>(std::ceil(std::min(wanted, most)));
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
        const auto is_in = static_cast<std::size_t>(next <= n);
        // Reads the first number, which is always there, in place of those beyond the end.
        const auto is_up_to = static_cast<std::size_t>(numbers[(next - 1) * is_in] <= x);
        count += step * (is_in & is_up_to);
    }
    return count;
}

/// Rounds positive weights to whole numbers that add up to `sum`, none of them to zero. There must
/// be fewer weights than `sum`. Returns the sums of those before each; all zero without weights.
template <std::size_t count>
std::array<std::uint32_t, count + 1> to_whole(const std::array<double, count>& weights,
                                              std::uint32_t sum)
{
    double all = 0.0;
    std::uint32_t positive = 0;
    for (const double weight : weights) {
        all += weight;
        positive += weight > 0.0 ? 1U : 0U;
    }
    std::array<std::uint32_t, count + 1> result{};
    if (!(all > 0.0)) {
        return result;
    }
    double before = 0.0;
    std::uint32_t ones = 0;
    for (std::size_t i = 0; i < count; ++i) {
        before += weights[i];
        ones += weights[i] > 0.0 ? 1U : 0U;
        result[i + 1] = ones + static_cast<std::uint32_t>(std::floor(
                                   before / all * static_cast<double>(sum - positive) + 1e-9));
    }
    result[count] = sum;
    return result;
}

constexpr Vec3 straight_up(0.0f, 1.0f, 0.0f);

/// Generates numbers in [0, 1), the same in every run.
class FixedNumbers {
public:
    explicit FixedNumbers(std::uint64_t seed) : state_(split_mix(seed)) {}
    float next()
    {
        state_ += golden_ratio_64;
        return static_cast<float>(split_mix(state_) >> 40U) * 0x1p-24f;
    }

private:
    std::uint64_t state_;
};

/// Returns a rough estimate of the luminance of the irradiance.
float light_at(const LightSet& lights, const GroundOccluders& occluders, std::size_t place,
               float height)
{
    constexpr int samples = 16;
    FixedNumbers numbers(place);
    float sum = 0.0f;
    for (int i = 0; i < samples; ++i) {
        const Vec2 within(numbers.next(), numbers.next());
        const Vec2 at = occluders.point(place, within);
        const LightSampleContext receiver{.p = {at.x, height, at.y}, .normal = straight_up};
        const float u_light = numbers.next();
        const Vec2 u(numbers.next(), numbers.next());
        const float time = numbers.next();
        const auto choice = lights.choose_placed(receiver, static_cast<double>(u_light));
        if (!choice) {
            continue;
        }
        const auto light =
            lights[choice->id].sample_incident(receiver, u, EnvironmentSampling::plain, time);
        const float found = light && light->wi.y > 0.0f
                                ? luminance(light->wi.y / choice->probability * light->weight)
                                : 0.0f;
        sum += std::isfinite(found) ? found : 0.0f;
    }
    return sum / static_cast<float>(samples);
}

}  // namespace

GroundSky::GroundSky(const EnvironmentLight& sky, const GroundOccluders& occluders)
    : sky_(sky), occluders_(occluders), strips_(strips), cells_(strips * rows), irradiances_(strips)
{
    for (std::size_t row = 0; row <= rows; ++row) {
        const float sine =
            sin_cos(0.5f * pi * static_cast<float>(row) / static_cast<float>(rows)).sin;
        sines_squared_[row] = row == rows ? 1.0f : sine * sine;
    }
    for (std::size_t row = 0; row < rows; ++row) {
        projected_[row] =
            pi / static_cast<float>(columns) * (sines_squared_[row + 1] - sines_squared_[row]);
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
            weight += static_cast<double>(this->weight(strip, blocked));
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
    Weights weights(columns);
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
            weights[column][row] = std::max(means[column][row], min_share * most);
        }
    });
    fill_distribution(weights);
    for (std::size_t column = 0; column < columns; ++column) {
        RowSums& strip = irradiances_[column / columns_of_strip];
        double above = 0.0;
        for (std::size_t row = 0; row < rows; ++row) {
            above += static_cast<double>(means[column][row]);
            strip[row + 1] += above;
        }
    }
}

void GroundSky::fill_distribution(const Weights& weights)
{
    for (std::size_t strip = 0; strip < strips; ++strip) {
        std::array<double, rows> of_rows{};
        double all = 0.0;
        for (std::size_t row = 0; row < rows; ++row) {
            std::array<double, columns_of_strip> of_cells{};
            for (std::size_t i = 0; i < columns_of_strip; ++i) {
                of_cells[i] = static_cast<double>(weights[strip * columns_of_strip + i][row]);
                of_rows[row] += of_cells[i];
            }
            all += of_rows[row];
            const auto sums = to_whole(of_cells, cell_units);
            for (std::size_t i = 0; i < columns_of_strip; ++i) {
                cells_[strip * rows + row][i] = static_cast<std::uint8_t>(sums[i]);
            }
        }
        constexpr std::uint32_t units = 65535;
        const auto sums = to_whole(of_rows, units);
        strips_[strip].scale = static_cast<float>(all / units);
        std::copy(sums.begin(), sums.end(), strips_[strip].sums.begin());
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
    const auto& sums = strips_[strip].sums;
    const int units = sums[blocked.end] - sums[blocked.begin];
    if (units == 0) {
        return nothing;
    }
    const float up_to = std::min(u.y, below_one) * static_cast<float>(units);
    const int unit = std::min(static_cast<int>(up_to), units - 1);
    const std::size_t row =
        blocked.begin +
        count_up_to(sums.data() + blocked.begin + 1, std::size_t{blocked.end} - blocked.begin - 1U,
                    static_cast<std::uint16_t>(sums[blocked.begin] + unit), rows / 2);
    const auto of_row = static_cast<float>(sums[row + 1] - sums[row]);
    const float along =
        std::min((up_to - static_cast<float>(sums[row] - sums[blocked.begin])) / of_row, below_one);
    // A cell of both, by what is left of the first.
    const float before = strip > 0 ? from.weights[strip - 1] : 0.0f;
    const float left =
        std::clamp((target - before) / (strips_[strip].scale * static_cast<float>(units)), 0.0f,
                   below_one) *
        static_cast<float>(cell_units);
    const Cells& row_of_cells = cells_[strip * rows + row];
    const auto cell_unit = static_cast<std::uint8_t>(left);
    std::size_t cell = 0;
    for (std::size_t i = 1; i < columns_of_strip; ++i) {
        cell += row_of_cells[i] <= cell_unit ? 1U : 0U;
    }
    const std::uint32_t cell_end =
        cell + 1 < columns_of_strip ? row_of_cells[cell + 1] : cell_units;
    const auto of_cell = static_cast<float>(cell_end - row_of_cells[cell]);
    const float across =
        std::min((left - static_cast<float>(row_of_cells[cell])) / of_cell, below_one);
    const std::size_t column = strip * columns_of_strip + cell;
    // In a cell all of the projected solid angle is the same.
    const float sine_squared =
        sines_squared_[row] + along * (sines_squared_[row + 1] - sines_squared_[row]);
    const float azimuth =
        (static_cast<float>(column) + across) / static_cast<float>(columns_of_strip);
    const Vec3 to_light = to_direction(azimuth, std::sqrt(sine_squared),
                                       std::sqrt(std::max(1.0f - sine_squared, 0.0f)));
    const float probability =
        strips_[strip].scale * of_row * of_cell / (from.weight * static_cast<float>(cell_units));
    return {.to_light = to_light, .over_density = projected_[row] / probability};
}

GroundLamps::GroundLamps(const LightSet& lights, const GroundOccluders& occluders, float height,
                         float elsewhere)
{
    if (!(elsewhere > 0.0f) || occluders.empty()) {
        return;
    }
    std::vector<float> shares(occluders.place_count());
    tbb::parallel_for(std::size_t{0}, shares.size(), [&](std::size_t place) {
        const float lamps = light_at(lights, occluders, place, height);
        shares[place] = lamps / (lamps + elsewhere);
    });
    // The greatest share around each place, for the estimate of one may have missed a lamp.
    constexpr float min_chance = 1.0f / 128.0f;
    constexpr float certain_share = 0.25f;
    constexpr std::size_t side = GroundOccluders::side;
    chances_.resize(shares.size());
    for (std::size_t z = 0; z < side; ++z) {
        for (std::size_t x = 0; x < side; ++x) {
            float most = 0.0f;
            for (std::size_t j = z - std::min<std::size_t>(z, 1); j <= std::min(z + 1, side - 1);
                 ++j) {
                for (std::size_t i = x - std::min<std::size_t>(x, 1);
                     i <= std::min(x + 1, side - 1); ++i) {
                    most = std::max(most, shares[j * side + i]);
                }
            }
            chances_[z * side + x] = std::clamp(most / certain_share, min_chance, 1.0f);
        }
    }
}

}  // namespace bdpt
