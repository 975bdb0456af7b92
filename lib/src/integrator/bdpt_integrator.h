#pragma once

#include "camera/pixel_filter.h"
#include "integrator/integrator.h"
#include "path/connect.h"

namespace bdpt {

/// Bidirectional path tracing [Veach 1997, ch. 10]: each sample joins every prefix of a camera
/// subpath to every prefix of a light subpath. All strategies but s = t = 1 (lights are seen by
/// hitting them) and t = 0 (a pinhole is never hit).
class BdptIntegrator final : public Integrator {
public:
    BdptIntegrator(const World& world, const Camera& camera, const RenderOptions& options);
    [[nodiscard]] RenderStats render_tile(const Tile& tile, SampleRange samples,
                                          Film& film) const override;
    [[nodiscard]] bool splats() const override { return true; }

private:
    /// The storage of one thread.
    struct Scratch {
        Subpath light_path;
        Subpath camera_path;
        PathWeigher weigher;
        RenderStats stats;
    };

    [[nodiscard]] Rgb estimate(std::int64_t sample_index, Sampler& sampler, Scratch& scratch,
                               Film& film) const;
    [[nodiscard]] std::optional<Contribution> connect(std::span<const PathVertex> light,
                                                      std::span<const PathVertex> camera,
                                                      Sampler& sampler, Scratch& scratch) const;

    const World& world_;
    const Camera& camera_;
    RenderOptions options_;
    PixelFilter filter_;
};

}  // namespace bdpt
