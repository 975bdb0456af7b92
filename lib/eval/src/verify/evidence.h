#pragma once

#include <bdpt/eval/statistics.h>
#include <bdpt/eval/verify.h>
#include <bdpt/film/film.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "verify/path_sums.h"

namespace bdpt::eval {

/// Integrators that are compared with bdpt, vcm only if requested.
constexpr std::array<IntegratorKind, 5> other_integrators{IntegratorKind::pt, IntegratorKind::nee,
                                                          IntegratorKind::mis, IntegratorKind::lt,
                                                          IntegratorKind::vcm};

/// Returns how many of `other_integrators` are tested, counted from the first.
[[nodiscard]] inline std::size_t count_of_others(const VerifyOptions& options)
{
    return options.merge_radius ? other_integrators.size() : other_integrators.size() - 1;
}

/// Returns the samples per pixel that a batch takes of paths of this length.
[[nodiscard]] constexpr int count_samples(IntegratorKind integrator, int edges)
{
    return integrator == IntegratorKind::bdpt               ? bdpt_samples
           : integrator == IntegratorKind::mis              ? mis_samples
           : integrator == IntegratorKind::pt && edges == 1 ? direct_samples
                                                            : other_samples;
}

/// Self-checks of one integrator's image in a batch.
struct ImageCheck {
    FilmDefects defects;
    double lost = 0.0;  ///< see `ImageFinding::lost`

    /// Adds the checks of a later render.
    ImageCheck& operator+=(const ImageCheck& later);
};

template <typename T>
using PerImage = std::array<T, 1 + other_integrators.size()>;

/// One batch: independent samples of all integrators.
struct Batch {
    PathSums bdpt;
    std::vector<RadianceSums> others;   ///< in the order of `other_integrators`
    PerImage<ImageCheck> images;        ///< bdpt, then `other_integrators` in their order
    std::optional<MergeSums> merges{};  ///< if vcm is among the others
    /// The same samples by `channel_measures`, without `images`. Optional.
    std::vector<Batch> channels{};
};

/// Statistics over batches of a strategy in a tile or in the whole image.
struct StrategyEvidence {
    Moments difference;  ///< tested - expected, a mean over samples and pixels
    StrategySums sums;
};

struct LengthEvidence {
    Moments radiance;
    Moments from_camera;
    Moments from_light;
    std::array<Moments, other_integrators.size()> others;
    /// Second moments of the samples of `others`.
    std::array<SecondMoment, other_integrators.size()> seen;
    LengthSums sums;
};

/// Statistics over batches of merging.
struct MergeEvidence {
    Moments difference;  ///< tested - expected, a mean over samples and pixels
    MergeSumsOfLength sums;
};

/// Statistics over all batches, by cell: the tiles, then the whole image.
class Evidence {
public:
    /// Takes batches with sums of the first `others` of `other_integrators`.
    Evidence(const TileGrid& grid, int max_depth, std::size_t others);

    void add(const Batch& batch);

    [[nodiscard]] const TileGrid& grid() const { return grid_; }
    [[nodiscard]] const StrategyRow& row() const { return row_; }
    [[nodiscard]] std::size_t whole() const { return grid_.size(); }
    [[nodiscard]] std::size_t others() const { return others_; }
    [[nodiscard]] std::int64_t batches() const { return batches_; }
    [[nodiscard]] const StrategyEvidence& strategy(std::size_t cell, std::size_t index) const
    {
        return strategies_[cell * row_.size() + index];
    }
    [[nodiscard]] const LengthEvidence& length(std::size_t cell, int edges) const
    {
        return lengths_[cell * static_cast<std::size_t>(row_.max_depth()) +
                        static_cast<std::size_t>(edges - 1)];
    }
    /// Returns the sum over all batches of `PathSums::expected_from`.
    [[nodiscard]] double expected_from(int edges, std::size_t u, std::size_t finder) const
    {
        return finders_[row_.pair(edges, u, finder)];
    }
    /// Returns the evidence on merging in the whole image; only if vcm is tested.
    [[nodiscard]] const MergeEvidence& merges(int edges) const
    {
        return merges_[static_cast<std::size_t>(edges - 1)];
    }
    [[nodiscard]] bool knows_merges() const { return !merges_.empty(); }
    /// Returns the evidence by `channel_measures`, for the whole image; empty if the batches had
    /// none.
    [[nodiscard]] const std::vector<Evidence>& channels() const { return channels_; }
    /// Returns statistics over all path lengths: bdpt, then `other_integrators`.
    [[nodiscard]] const PerImage<Moments>& images() const { return images_; }
    [[nodiscard]] const PerImage<ImageCheck>& checks() const { return checks_; }
    [[nodiscard]] const WeightFinding& weights() const { return weights_; }
    /// Returns the number of pixels of a cell.
    [[nodiscard]] double pixels(std::size_t cell) const
    {
        return cell == whole() ? grid_.pixels() : grid_.pixels(cell);
    }

    /// Returns the samples of an integrator in a cell, for paths of that length.
    [[nodiscard]] double samples_in(std::size_t cell, IntegratorKind kind, int edges) const
    {
        return count_samples(kind, edges) * pixels(cell) * static_cast<double>(batches_);
    }
    /// Returns the samples of bdpt in a cell.
    [[nodiscard]] double bdpt_samples_in(std::size_t cell) const
    {
        return bdpt_samples * pixels(cell) * static_cast<double>(batches_);
    }

private:
    void add_strategies(const Batch& batch);
    void add_lengths(const Batch& batch);
    void add_images(const Batch& batch);
    void add_merges(const MergeSums& sums);

    TileGrid grid_;
    StrategyRow row_;
    std::size_t others_;
    std::int64_t batches_ = 0;
    std::vector<StrategyEvidence> strategies_;  // by cell, then by index
    std::vector<LengthEvidence> lengths_;       // by cell, then by length
    std::vector<double> finders_;               // by pair
    PerImage<Moments> images_;
    PerImage<ImageCheck> checks_;
    WeightFinding weights_;
    std::vector<MergeEvidence> merges_;  // by length
    std::vector<Evidence> channels_;
};

/// Renders batch `number` on the calling thread: a pure function of its arguments.
[[nodiscard]] Batch render_batch(const Scene& scene, const CameraDesc& camera,
                                 const VerifyOptions& options, const TileGrid& grid,
                                 std::int64_t number);

}  // namespace bdpt::eval
