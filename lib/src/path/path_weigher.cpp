#include "path/path_weigher.h"

#include "camera/camera.h"
#include "path/densities.h"

namespace bdpt {

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
