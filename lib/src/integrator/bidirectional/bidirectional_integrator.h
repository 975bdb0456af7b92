#pragma once

#include "film/pixel_filter.h"
#include "integrator/bidirectional/light_path_cache.h"
#include "integrator/bidirectional/light_vertex_grid.h"
#include "integrator/bidirectional/path_joiner.h"
#include "integrator/integrator.h"
#include "path/merge.h"
#include "path/random_walk.h"

namespace bdpt {

/// Bidirectional path tracing [Veach 1997, ch. 10]: traces for each sample its camera path and the
/// light paths that `PathJoiner` connects it to. Light tracing uses the strategies t <= 1 alone.
/// Light paths belong to one camera path, or to all of a sample index: then each camera path is
/// connected to a few of them. Vertex connection and merging [Georgiev et al. 2012] also merges
/// each camera path with the vertices of all of them.
class BidirectionalIntegrator final : public Integrator {
public:
    BidirectionalIntegrator(const World& world, const MovingCamera& camera,
                            const RenderOptions& options, const LearnedLight* learned = nullptr);
    [[nodiscard]] std::int64_t max_samples_in_pass() const override;
    [[nodiscard]] std::int64_t batches() const override { return cache_.counts().batches; }
    [[nodiscard]] ChunkRange begin_batch(SampleRange samples, std::int64_t batch) override;
    [[nodiscard]] RenderStats render_chunk(std::int64_t part, SampleRange samples,
                                           const Films& films) override;
    void end_chunks() override;
    [[nodiscard]] int tile_side(int wanted) const override;
    [[nodiscard]] std::int64_t batch(const Tile& tile) const override
    {
        return cache_.batch(tile.x_begin, tile.y_begin);
    }
    [[nodiscard]] std::int64_t group(const Tile& tile) const override
    {
        return cache_.part(tile.x_begin, tile.y_begin);
    }
    [[nodiscard]] RenderStats render_tile(const Tile& tile, SampleRange samples,
                                          const Films& films) const override;

private:
    /// Storage of one thread.
    struct Scratch;

    /// Returns the number of light paths of each camera path that has its own.
    [[nodiscard]] int own_light_paths() const;
    void trace_light_path(SampleContext& sample, Scratch& scratch) const;
    void add_sample(int x, int y, const ScheduledSample& scheduled, Scratch& scratch) const;
    /// Returns the chance by which each light vertex near `p` is chosen to merge there.
    [[nodiscard]] double chance_of_merges(Vec3 p) const;
    void merge_paths(const SampleContext& sample, Scratch& scratch) const;

    const World& world_;
    const MovingCamera& camera_;
    RenderOptions options_;
    SampleSchedule schedule_;
    PixelFilter filter_;
    StrategySet strategies_;
    LightPathCache cache_;  ///< empty unless light paths are shared
    Merging merging_;       ///< merging of the pass's sample index
    LightVertexGrid grid_;  ///< vertices that may merge
};

}  // namespace bdpt
