#include "verify/path_sums.h"

#include <algorithm>
#include <cmath>

namespace bdpt::harness {
namespace {

/// Above this, which no scene reaches, sums of second moments could overflow.
constexpr double most = 1e150;

double mean_channel(Rgb c)
{
    return (static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b)) / 3.0;
}

double square(double x)
{
    return x * x;
}

/// Second moment, relative to `all`, what all strategies together make of a path, of a pair of
/// strategies with these shares that the power heuristic weighs; infinite without any.
double pair_second_moment(double all, double a, double b)
{
    const double greater = std::max(a, b);
    if (!(greater > 0.0)) {
        return most;
    }
    const double x = a / greater;
    const double y = b / greater;
    return all / greater * (x * x * x + y * y * y) / square(x * x + y * y);
}

double share_of(const FoundPath& path, std::size_t s)
{
    return s < path.shares.size() ? static_cast<double>(path.shares[s]) : 0.0;
}

}  // namespace

StrategySums& StrategySums::operator+=(const StrategySums& other)
{
    tested += other.tested;
    expected += other.expected;
    expected_by_others += other.expected_by_others;
    second_moment += other.second_moment;
    reach += other.reach;
    weighted += other.weighted;
    unweighted += other.unweighted;
    solitary += other.solitary;
    unchecked += other.unchecked;
    return *this;
}

ReachSums& ReachSums::operator+=(const ReachSums& other)
{
    radiance += other.radiance;
    second_moment += other.second_moment;
    return *this;
}

LengthSums& LengthSums::operator+=(const LengthSums& other)
{
    radiance += other.radiance;
    from_camera += other.from_camera;
    from_light += other.from_light;
    second_moment_pt += other.second_moment_pt;
    second_moment_nee += other.second_moment_nee;
    second_moment_mis += other.second_moment_mis;
    second_moment_lt += other.second_moment_lt;
    return *this;
}

PathSums::PathSums(const TileGrid& grid, int max_depth)
    : grid_(grid),
      row_(max_depth),
      strategies_(grid.size() * row_.size()),
      lengths_(grid.size() * static_cast<std::size_t>(max_depth))
{}

void PathSums::check_weight(const FoundPath& path, double definition)
{
    constexpr double tolerance = 1e-3;  // far above what rounding does
    const double difference = std::abs(static_cast<double>(path.weight) - definition);
    ++weights_.paths;
    if (!(difference <= tolerance)) {
        ++weights_.wrong;
    }
    weights_.worst = std::isnan(difference) ? 1.0 : std::max(weights_.worst, difference);
}

void PathSums::add(const FoundPath& path)
{
    const int edges = path.strategy.s + path.strategy.t - 1;
    const double unweighted = mean_channel(path.unweighted);
    if (edges > row_.max_depth() || !std::isfinite(unweighted)) {
        return;
    }
    double squares = 0.0;
    for (const float share : path.shares) {
        squares += square(static_cast<double>(share));
    }
    const auto own = static_cast<std::size_t>(path.strategy.s);
    const double own_share = share_of(path, own);
    // A strategy that found what it claims that it cannot find has no share: its weight is wrong.
    check_weight(path, squares > 0.0 ? square(own_share) / squares : 0.0);
    if (!(squares > 0.0)) {
        return;
    }
    const double weighted = static_cast<double>(path.weight) * unweighted;
    // What the balance heuristic makes of the path, the same whoever finds it.
    const double all = std::min(own_share * unweighted, most);
    double variance = 0.0;  // second moment of a sample of bdpt along this path
    for (const float share : path.shares) {
        const auto b = static_cast<double>(share);
        variance += b > 0.0 ? square(b * b / squares) * all / b : 0.0;
    }

    const std::size_t tile = grid_.tile_at(path.raster);
    const std::size_t first = tile * row_.size() + row_.begin(edges);
    for (std::size_t u = 0; u < path.shares.size(); ++u) {
        const double share = share_of(path, u);
        if (!(share > 0.0)) {
            continue;
        }
        StrategySums& sums = strategies_[first + u];
        const double g = std::min(1.0, share / full_share);
        const double weight = square(share) / squares;
        sums.expected += g * weighted;
        sums.expected_by_others += u == own ? 0.0 : g * weighted;
        sums.reach += weighted;
        // Found by u the path brings (1 - w_u) / b_u, found by v it takes w_v / b_v.
        const double difference =
            square(1.0 - weight) * all / share + variance - square(weight) * all / share;
        sums.second_moment += weighted * square(g) * std::clamp(difference, 0.0, most);
    }
    StrategySums& sums = strategies_[first + own];
    sums.tested += std::min(1.0, own_share / full_share) * unweighted;
    sums.weighted += weighted;
    sums.unweighted += unweighted;
    const bool alone = own_share > 1.0 - 1e-6;
    const bool from_camera = own <= 1 || share_of(path, 0) > 0.0 || share_of(path, 1) > 0.0;
    sums.solitary += alone ? weighted : 0.0;
    sums.unchecked += alone && !from_camera ? weighted : 0.0;

    add_to_length(lengths_[tile * static_cast<std::size_t>(row_.max_depth()) +
                           static_cast<std::size_t>(edges - 1)],
                  path, weighted, all, variance);
}

void PathSums::add_to_length(LengthSums& sums, const FoundPath& path, double weighted, double all,
                             double variance) const
{
    const std::size_t n = path.shares.size() - 1;  // vertices
    const double hit = share_of(path, 0);
    // Of paths of one edge, s = 1 goes through the lens: no path tracer has that.
    const double next_event = n > 2 ? share_of(path, 1) : 0.0;
    const double to_lens = share_of(path, n - 1);
    const double hit_lens = share_of(path, n);
    const auto add = [weighted](double& sum, double second_moment) {
        sum += weighted * std::min(second_moment, most);
    };
    sums.radiance += weighted;
    if (hit > 0.0 || next_event > 0.0) {
        sums.from_camera.radiance += weighted;
        add(sums.from_camera.second_moment, variance);
        add(sums.second_moment_pt, all / (hit > 0.0 ? hit : next_event));
        add(sums.second_moment_nee, all / (next_event > 0.0 ? next_event : hit));
        add(sums.second_moment_mis, pair_second_moment(all, hit, next_event));
    }
    if (to_lens > 0.0 || hit_lens > 0.0) {
        sums.from_light.radiance += weighted;
        add(sums.from_light.second_moment, variance);
        add(sums.second_moment_lt, pair_second_moment(all, to_lens, hit_lens));
    }
}

}  // namespace bdpt::harness
