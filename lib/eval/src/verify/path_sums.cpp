#include "verify/path_sums.h"

#include <algorithm>
#include <cmath>

namespace bdpt::eval {

namespace {

double square(double x)
{
    return x * x;
}

/// A strategy that finds a path.
struct Technique {
    double share = 0.0;
    double max_weight = 1.0;  // by roulette
};

/// Adds the second moment of the samples of two strategies, weighted by the power heuristic, along
/// a path for which all strategies together estimate `all`; nothing without a share.
void add_pair(SecondMoment& moment, double weighted, double all, Technique a, Technique b)
{
    const double greater = std::max(a.share, b.share);
    if (!(greater > 0.0)) {
        return;
    }
    // Divided by the greater one first, as squares of small shares would underflow.
    const double x = a.share / greater;
    const double y = b.share / greater;
    const double sum = x * x + y * y;
    const double size = all / greater / sum;
    moment.add(size * x * a.max_weight, weighted * size / sum * x * x * x * a.max_weight);
    moment.add(size * y * b.max_weight, weighted * size / sum * y * y * y * b.max_weight);
}

double find_share(const PathContribution& path, std::size_t s)
{
    return s < path.shares.size() ? static_cast<double>(path.shares[s]) : 0.0;
}

}  // namespace

StrategySums& StrategySums::operator+=(const StrategySums& other)
{
    tested += other.tested;
    expected += other.expected;
    second_moment += other.second_moment;
    seen += other.seen;
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
    seen += other.seen;
    return *this;
}

LengthSums& LengthSums::operator+=(const LengthSums& other)
{
    all += other.all;
    from_camera += other.from_camera;
    from_light += other.from_light;
    pt += other.pt;
    nee += other.nee;
    mis += other.mis;
    lt += other.lt;
    return *this;
}

PathSums::PathSums(const TileGrid& grid, int max_depth, SampleCounts counts, Measure measure)
    : grid_(grid),
      row_(max_depth),
      counts_(counts),
      measure_(measure),
      roulette_(max_depth),
      strategies_(grid.size() * row_.size()),
      lengths_(grid.size() * static_cast<std::size_t>(max_depth)),
      finders_(row_.pairs())
{}

void PathSums::check_weight(const PathContribution& path, double definition)
{
    constexpr double tolerance = 1e-3;  // far above rounding errors
    const double difference = std::abs(static_cast<double>(path.weight) - definition);
    ++weights_.paths;
    if (!(difference <= tolerance)) {
        ++weights_.wrong;
    }
    weights_.worst = std::isnan(difference) ? 1.0 : std::max(weights_.worst, difference);
}

void PathSums::add(const PathContribution& path)
{
    const int edges = path.strategy.s + path.strategy.t - 1;
    const double unweighted = measured(measure_, path.unweighted);
    if (edges > row_.max_depth() || !std::isfinite(unweighted)) {
        return;
    }
    double squares = 0.0;
    for (const float share : path.shares) {
        squares += square(static_cast<double>(share));
    }
    const auto own = static_cast<std::size_t>(path.strategy.s);
    const double own_share = find_share(path, own);
    // A strategy that finds a path which it claims it cannot find has no share: its weight is
    // wrong.
    check_weight(path, squares > 0.0 ? square(own_share) / squares : 0.0);
    if (!(squares > 0.0)) {
        return;
    }
    const double all = own_share * unweighted;
    PathValue measure{.weighted = static_cast<double>(path.weight) * unweighted,
                      .all = all,
                      .squares = squares,
                      .moment = 0.0,
                      .largest = 0.0};
    for (std::size_t s = 0; s < path.shares.size(); ++s) {
        const double share = find_share(path, s);
        // w / b with w = b^2 / squares
        const double sample = share / squares * all * max_weight(edges, s);
        measure.moment += sample * square(share) / squares;
        measure.largest = std::max(measure.largest, sample);
    }
    const std::size_t tile = grid_.tile_at(path.raster);
    const std::size_t first = tile * row_.size() + row_.begin(edges);
    add_to_strategies(path, measure, first);
    StrategySums& sums = strategies_[first + own];
    sums.tested += std::min(1.0, own_share / full_share) * unweighted;
    sums.weighted += measure.weighted;
    sums.unweighted += unweighted;
    const bool alone = own_share > 1.0 - 1e-6;
    const bool from_camera = own <= 1 || find_share(path, 0) > 0.0 || find_share(path, 1) > 0.0;
    sums.solitary += alone ? measure.weighted : 0.0;
    sums.unchecked += alone && !from_camera ? measure.weighted : 0.0;
    add_to_length(lengths_[tile * static_cast<std::size_t>(row_.max_depth()) +
                           static_cast<std::size_t>(edges - 1)],
                  path, measure);
}

void PathSums::add_to_strategies(const PathContribution& path, const PathValue& measure,
                                 std::size_t first)
{
    const auto& [weighted, all, squares, moment, largest] = measure;
    const auto own = static_cast<std::size_t>(path.strategy.s);
    const int edges = path.strategy.s + path.strategy.t - 1;
    for (std::size_t u = 0; u < path.shares.size(); ++u) {
        const double share = find_share(path, u);
        if (!(share > 0.0)) {
            continue;
        }
        StrategySums& sums = strategies_[first + u];
        const double g = std::min(1.0, share / full_share);
        const double weight = square(share) / squares;
        sums.expected += g * weighted;
        finders_[row_.pair(edges, u, own)] += g * weighted;
        sums.reach += weighted;
        // If u finds the path, it adds g (1 - w_u) / b_u to the difference; if v does, it subtracts
        // g w_v / b_v.
        const double by_own = (1.0 - weight) * g * all / share;
        const double most = max_weight(edges, u);
        sums.second_moment.add(most * by_own, weighted * most * by_own * (1.0 - weight) * g);
        const double by_others = moment - square(weight) * most * all / share;
        sums.second_moment.add(g * largest, weighted * square(g) * std::max(by_others, 0.0));
        if (u == own) {
            sums.seen.add(by_own, square(by_own));
        } else {
            sums.seen.add(g * largest, square(g * weighted));
        }
    }
}

void PathSums::add_to_length(LengthSums& sums, const PathContribution& path,
                             const PathValue& measure) const
{
    const std::size_t n = path.shares.size() - 1;  // vertices
    const int edges = path.strategy.s + path.strategy.t - 1;
    const auto technique = [&](std::size_t s) {
        return Technique{.share = find_share(path, s), .max_weight = max_weight(edges, s)};
    };
    const Technique hit = technique(0);
    // For paths of one edge, s = 1 passes through the lens, which no path tracer samples.
    const Technique next_event = n > 2 ? technique(1) : Technique{};
    // Light tracing has one light path per pixel, whatever bdpt has.
    const auto from_one = [&](Technique of_all) {
        return Technique{.share = of_all.share / counts_.light_paths,
                         .max_weight = of_all.max_weight};
    };
    const Technique to_lens = from_one(technique(n - 1));
    const Technique hit_lens = from_one(technique(n));
    const double weighted = measure.weighted;
    const double all = measure.all;
    const auto reach = [&](ReachSums& reached) {
        reached.radiance += weighted;
        reached.second_moment.add(measure.largest, weighted * measure.moment);
        reached.seen.add(measure.largest, square(weighted));
    };
    reach(sums.all);
    if (hit.share > 0.0 || next_event.share > 0.0) {
        reach(sums.from_camera);
        add_pair(sums.pt, weighted, all, hit.share > 0.0 ? hit : next_event, {});
        add_pair(sums.nee, weighted, all, next_event.share > 0.0 ? next_event : hit, {});
        add_pair(sums.mis, weighted, all, hit, next_event);
    }
    if (to_lens.share > 0.0 || hit_lens.share > 0.0) {
        reach(sums.from_light);
        add_pair(sums.lt, weighted, all, to_lens, hit_lens);
    }
}

namespace {

/// Returns the share of all merges of the path. Sums of floats are off by some 1e-7: shares below
/// 1e-4 count as 0, whichever technique found the path.
double share_of_merges(const PathContribution& path)
{
    constexpr double min_share = 1e-4;
    double joins = 0.0;
    for (const float share : path.shares) {
        joins += static_cast<double>(share);
    }
    const double share = 1.0 - joins;
    return share >= min_share ? share : 0.0;
}

}  // namespace

MergeSumsOfLength& MergeSumsOfLength::operator+=(const MergeSumsOfLength& other)
{
    brought += other.brought;
    tested += other.tested;
    expected += other.expected;
    by_merges += other.by_merges;
    second_moment += other.second_moment;
    seen += other.seen;
    return *this;
}

void MergeSums::add(const PathContribution& path)
{
    const int edges = count_edges(path);
    // By the balance heuristic a weighted contribution is f over the sum of all densities.
    const double weighted = static_cast<double>(path.weight) * measured(measure_, path.unweighted);
    if (edges > static_cast<int>(lengths_.size()) || !std::isfinite(weighted)) {
        return;
    }
    MergeSumsOfLength& sums = lengths_[static_cast<std::size_t>(edges - 1)];
    sums.brought += path.merged ? weighted : 0.0;
    const double share = share_of_merges(path);
    if (!(share > 0.0)) {
        return;
    }
    const double g = std::min(1.0, share / full_share);
    const double sample = g * weighted / share;  // f over the sum of the densities of merges
    sums.expected += g * weighted;
    // Of all merges of a path of this length, roulette thins this one most.
    const double most = roulette_.max_weight({.s = edges, .t = 2});
    sums.second_moment.add(most * sample, most * weighted * g * sample);
    if (path.merged) {
        sums.tested += sample;
        sums.by_merges += g * weighted;
        sums.seen.add(sample, sample * sample);
    }
}

}  // namespace bdpt::eval
