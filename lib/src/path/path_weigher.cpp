#include "path/path_weigher.h"

#include "camera/camera.h"
#include "path/densities.h"

#include <cassert>

namespace bdpt {

namespace {

/// Returns the weight of the heuristics that compare all strategies with the best one. The
/// densities of all are products in the same order for every caller, so that ties are broken
/// consistently.
float compared_weight(const PathDensities& path, std::size_t used, Heuristic heuristic)
{
    const std::size_t n = path.from_light.size();
    const auto density = [&](std::size_t s) { return strategy_density(path, s); };
    long double greatest = 0.0L;
    std::size_t first_greatest = 0;
    for (std::size_t s = 0; s <= n; ++s) {
        if (const long double p = density(s); p > greatest) {
            greatest = p;
            first_greatest = s;
        }
    }
    if (heuristic == Heuristic::maximum) {
        return used == first_greatest ? 1.0f : 0.0f;
    }
    constexpr long double cutoff = 0.1L;  // alpha [Veach 1997, sec. 9.2.3.2]
    const auto share = [&](long double p) {
        if (heuristic == Heuristic::uniform) {
            return p > 0.0L ? 1.0L : 0.0L;
        }
        return p >= cutoff * greatest ? p / greatest : 0.0L;
    };
    long double sum = 0.0L;
    for (std::size_t s = 0; s <= n; ++s) {
        sum += share(density(s));
    }
    return sum > 0.0L ? static_cast<float>(share(density(used)) / sum) : 0.0f;
}

/// Sum over strategies in the balance and power heuristics, relative to the strategy in use. Every
/// divisor is a density with which it sampled, so it is never zero.
class RelativeSum {
public:
    /// `own` is the number of samples of the strategy in use, if it is not in the ratios.
    RelativeSum(const PathDensities& path, Heuristic heuristic, float own)
        : path_(path), squares_(heuristic == Heuristic::power), own_(own)
    {}

    /// Moves vertices from, from + 1, ... to the light subpath, one at a time; `ratio` is that of
    /// the vertices already moved.
    void hand_to_light(std::size_t from, double ratio)
    {
        const auto& light = path_.from_light;
        const auto& camera = path_.from_camera;
        for (std::size_t i = from; i < light.size(); ++i) {
            if (i == 0 && path_.sample_counts[1] > 0.0f) {
                add(path_.sample_counts[1], quotient(path_.next_event, camera[0]));
            }
            add_merge(i, ratio, light[i]);
            ratio *= quotient(light[i], camera[i]);
            if (i > 0 && path_.sample_counts[i + 1] > 0.0f) {
                add(path_.sample_counts[i + 1], ratio);
            }
        }
    }
    /// Moves vertices from - 1, from - 2, ... to the camera subpath; x_0 is sampled with density
    /// `start`.
    void hand_to_camera(std::size_t from, double ratio, AreaPdf start)
    {
        const auto& light = path_.from_light;
        const auto& camera = path_.from_camera;
        for (std::size_t i = from; i-- > 1;) {
            add_merge(i, ratio, camera[i]);
            ratio *= quotient(camera[i], light[i]);
            if (path_.sample_counts[i] > 0.0f) {
                add(path_.sample_counts[i],
                    i == 1 ? ratio * quotient(path_.next_event, light[0]) : ratio);
            }
        }
        if (from > 0 && path_.sample_counts[0] > 0.0f) {
            add(path_.sample_counts[0], ratio * quotient(camera[0], start));
        }
    }
    void add(float count, double density_ratio)
    {
        const double ratio = density_ratio * static_cast<double>(count / own_);
        sum_ += squares_ ? ratio * ratio : ratio;
    }
    [[nodiscard]] float weight() const { return static_cast<float>(1.0 / sum_); }

    static double quotient(AreaPdf a, AreaPdf b)
    {
        return static_cast<double>(a.value) / static_cast<double>(b.value);
    }

private:
    /// Adds the term of sampling x_i from both sides: `other` is the density of the side that did
    /// not sample it.
    void add_merge(std::size_t i, double ratio, AreaPdf other)
    {
        if (!path_.merge_weights.empty() && path_.merge_weights[i] > 0.0f) {
            add(path_.merge_weights[i], ratio * static_cast<double>(other.value));
        }
    }

    const PathDensities& path_;
    bool squares_;
    float own_;
    double sum_ = 1.0;  // in double, because the products over a long path exceed the range of
                        // float
};

}  // namespace

long double strategy_density(const PathDensities& path, std::size_t s)
{
    auto product = static_cast<long double>(path.sample_counts[s]);
    for (std::size_t i = 0; i < path.from_light.size() && product > 0.0L; ++i) {
        const AreaPdf pdf = i >= s             ? path.from_camera[i]
                            : i == 0 && s == 1 ? path.next_event
                                               : path.from_light[i];
        product *= static_cast<long double>(pdf.value);
    }
    return product;
}

long double strategy_densities(const PathDensities& path, std::span<long double> densities)
{
    const std::size_t n = path.from_light.size();
    long double from_camera = 1.0L;
    densities[n] = 1.0L;
    for (std::size_t i = n; i-- > 0;) {
        from_camera *= static_cast<long double>(path.from_camera[i].value);
        densities[i] = from_camera;
    }
    long double from_light = 1.0L;
    long double merges = 0.0L;
    for (std::size_t s = 0; s <= n; ++s) {
        const long double start =
            s == 1 ? static_cast<long double>(path.next_event.value) : from_light;
        const long double rest = densities[s];
        const float count = path.sample_counts[s];
        densities[s] = count > 0.0f ? static_cast<long double>(count) * start * rest : 0.0L;
        if (s < n) {
            from_light *= static_cast<long double>(path.from_light[s].value);
            if (!path.merge_weights.empty() && path.merge_weights[s] > 0.0f) {
                merges += static_cast<long double>(path.merge_weights[s]) * from_light * rest;
            }
        }
    }
    return merges;
}

float mis_weight(const PathDensities& path, int s, Heuristic heuristic)
{
    if (heuristic != Heuristic::balance && heuristic != Heuristic::power) {
        return compared_weight(path, static_cast<std::size_t>(s), heuristic);
    }
    const auto used = static_cast<std::size_t>(s);
    assert(path.from_camera.size() == path.from_light.size() &&
           path.sample_counts.size() == path.from_light.size() + 1);
    assert(path.sample_counts[used] > 0.0f);
    const AreaPdf start = used == 1 ? path.next_event : path.from_light[0];
    RelativeSum sum(path, heuristic, path.sample_counts[used]);
    sum.hand_to_light(used, used == 1 ? RelativeSum::quotient(path.from_light[0], start) : 1.0);
    sum.hand_to_camera(used, 1.0, start);
    return sum.weight();
}

float merge_weight(const PathDensities& path, int i, Heuristic heuristic)
{
    const auto merged = static_cast<std::size_t>(i);
    const auto& counts = path.sample_counts;
    const double count = static_cast<double>(path.merge_weights[merged]);
    assert(count > 0.0 && merged > 0 && merged + 1 < path.from_light.size());
    RelativeSum sum(path, heuristic, 1.0f);
    // Without sampling x_i from the camera, or from the light.
    const double by_light = 1.0 / (count * static_cast<double>(path.from_camera[merged].value));
    const double by_camera = 1.0 / (count * static_cast<double>(path.from_light[merged].value));
    sum.add(counts[merged + 1], by_light);
    sum.hand_to_light(merged + 1, by_light);
    sum.add(counts[merged],
            merged == 1 ? by_camera * RelativeSum::quotient(path.next_event, path.from_light[0])
                        : by_camera);
    sum.hand_to_camera(merged, by_camera, path.from_light[0]);
    return sum.weight();
}

PathWeigher::PathWeigher(const World& world, const Camera& camera, const StrategySet& strategies,
                         Heuristic heuristic, int max_vertices, double merge_weight)
    : world_(world),
      camera_(camera),
      strategies_(strategies),
      heuristic_(heuristic),
      from_light_(static_cast<std::size_t>(max_vertices)),
      from_camera_(static_cast<std::size_t>(max_vertices)),
      sample_counts_(static_cast<std::size_t>(max_vertices) + 1),
      merge_weights_(static_cast<std::size_t>(max_vertices)),
      merge_weight_(merge_weight),
      densities_(static_cast<std::size_t>(max_vertices) + 1),
      shares_(static_cast<std::size_t>(max_vertices) + 1)
{
    if (WeightSums::applies(strategies, heuristic)) {
        sums_.emplace(world, camera, strategies, heuristic, merge_weight);
    }
}

void PathWeigher::begin_camera_path(std::span<PathVertex> path)
{
    if (sums_) {
        sums_->sum_camera_path(path);
        uses_sums_ = true;
    }
}

void PathWeigher::begin_light_path(std::span<PathVertex> path)
{
    if (sums_) {
        sums_->sum_light_path(path);
        uses_sums_ = true;
    }
}

bool PathWeigher::is_seen_by_walks_alone(LightId light) const
{
    const bool by_connection =
        strategies_.uses(1, 1) && can_be_seen_directly(world_.lights()[light], camera_);
    const bool by_hit_of_lens = strategies_.uses(2, 0) && camera_.has_finite_lens();
    return !by_connection && !by_hit_of_lens && !keeps_paths_;
}

float PathWeigher::weight(std::span<const PathVertex> light, std::span<const PathVertex> camera,
                          const JoinDensities& join)
{
    size_ = light.size() + camera.size();
    const bool summed = uses_sums_ && size_ > 2;
    if (!summed || keeps_paths_) {
        gather_densities(light, camera, join);
        gather_sample_counts(light, camera, light.empty() ? Made::by_hit : Made::by_join);
        next_event_ = join.next_event;
    }
    if (summed) {
        return sums_->weight(light, camera, join);
    }
    return mis_weight(last_path(), static_cast<int>(light.size()), heuristic_);
}

float PathWeigher::weight_of_hit(std::span<const PathVertex> light, const PathVertex& lens,
                                 const JoinDensities& join)
{
    size_ = light.size() + 1;
    gather_densities(light, std::span(&lens, 1), join);
    gather_sample_counts(light, std::span(&lens, 1), Made::by_hit);
    next_event_ = join.next_event;
    return mis_weight(last_path(), static_cast<int>(size_), heuristic_);
}

float PathWeigher::weight_of_merge(std::span<const PathVertex> light,
                                   std::span<const PathVertex> camera, const JoinDensities& join)
{
    size_ = light.size() + camera.size() - 1;
    if (!uses_sums_ || keeps_paths_) {
        const auto before = light.first(light.size() - 1);
        gather_densities(before, camera, join);
        gather_sample_counts(before, camera, Made::by_merge);
        next_event_ = join.next_event;
    }
    if (uses_sums_) {
        return sums_->weight_of_merge(light, camera, join);
    }
    return merge_weight(last_path(), static_cast<int>(light.size()) - 1, heuristic_);
}

PathDensities PathWeigher::last_path() const
{
    return {.from_light = std::span(from_light_).first(size_),
            .from_camera = std::span(from_camera_).first(size_),
            .next_event = next_event_,
            .sample_counts = std::span(sample_counts_).first(size_ + 1),
            .merge_weights = std::span(merge_weights_).first(merge_weight_ > 0.0 ? size_ : 0)};
}

std::span<const float> PathWeigher::shares()
{
    long double sum = strategy_densities(last_path(), densities_);
    for (std::size_t s = 0; s <= size_; ++s) {
        sum += densities_[s];
    }
    for (std::size_t s = 0; s <= size_; ++s) {
        shares_[s] = sum > 0.0L ? static_cast<float>(densities_[s] / sum) : 0.0f;
    }
    return std::span(shares_).first(size_ + 1);
}

void PathWeigher::gather_densities(std::span<const PathVertex> light,
                                   std::span<const PathVertex> camera, const JoinDensities& join)
{
    const std::size_t s = light.size();
    const std::size_t t = camera.size();
    for (std::size_t i = 0; i < s; ++i) {
        from_light_[i] = light[i].pdf_fwd;
        from_camera_[i] = light[i].pdf_rev;
    }
    for (std::size_t j = 0; j < t; ++j) {
        from_light_[size_ - 1 - j] = camera[j].pdf_rev;
        from_camera_[size_ - 1 - j] = camera[j].pdf_fwd;
    }
    from_light_[s] = join.light_at_camera_end;
    if (t > 1) {
        from_light_[s + 1] = join.light_at_camera_neighbor;
    }
    if (s > 0) {
        from_camera_[s - 1] = join.camera_at_light_end;
    }
    if (s > 1) {
        from_camera_[s - 2] = join.camera_at_light_neighbor;
    }
}

void PathWeigher::gather_sample_counts(std::span<const PathVertex> light,
                                       std::span<const PathVertex> camera, Made made)
{
    const std::size_t s = light.size();
    const int n = static_cast<int>(size_);
    const auto vertex = [&](std::size_t i) -> const PathVertex& {
        return i < s ? light[i] : camera[size_ - 1 - i];
    };
    // Tests whether a strategy can connect at vertex i. The two ends of a connection are known to
    // be connectible, and so are the light that a path has hit and the merged vertex.
    const auto is_joinable = [&](std::size_t i) {
        const bool end = made == Made::by_hit    ? i == 0
                         : made == Made::by_join ? i == s || i + 1 == s
                                                 : i == s;
        return end || joinable(vertex(i));
    };
    const PathVertex& x0 = s > 0 ? light[0] : camera[size_ - 1];
    const Light& source = world_.lights()[*x0.light];
    sample_counts_[0] = source.is_delta() ? 0.0f : strategies_.count(0, n);
    scatters_in_body_ = false;
    bool left = is_joinable(0);
    for (std::size_t i = 1; i < size_; ++i) {
        const bool right = is_joinable(i);
        const int from_light = static_cast<int>(i);
        sample_counts_[i] = left && right ? strategies_.count(from_light, n - from_light) : 0.0f;
        if (i >= 2 && i + 1 < size_) {
            sample_counts_[i] *= connection_count(world_, vertex(i - 1), vertex(i));
        }
        const bool merges = right && i + 1 < size_ && vertex(i).kind == VertexKind::surface &&
                            strategies_.merges(from_light + 1, n - from_light);
        scatters_in_body_ = scatters_in_body_ || mean_scatterings(world_, vertex(i)) > 1.0f;
        merge_weights_[i] = merges ? static_cast<float>(merge_weight_) * vertex(i).opacity : 0.0f;
        left = right;
    }
    sample_counts_[size_] = camera_.has_finite_lens() ? strategies_.count(n, 0) : 0.0f;
    if (size_ == 2 && !can_be_seen_directly(source, camera_)) {
        sample_counts_[1] = 0.0f;
    }
}

}  // namespace bdpt
