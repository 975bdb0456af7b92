#pragma once

#include "camera/pixel_filter.h"
#include "integrator/integrator.h"
#include "path/connect.h"

#include <vector>

namespace bdpt {

/// Bidirectional path tracing [Veach 1997, ch. 10]: each sample joins every prefix of a camera
/// subpath to every prefix of one or more light subpaths. Light tracing is the same with the
/// strategies t <= 1 alone.
class BdptIntegrator final : public Integrator {
public:
    BdptIntegrator(const World& world, const MovingCamera& camera, const RenderOptions& options);
    [[nodiscard]] RenderStats render_tile(const Tile& tile, SampleRange samples,
                                          const Films& films) const override;
    [[nodiscard]] bool splats() const override { return true; }

private:
    /// What waits for its pixel to come from memory.
    struct PendingSplat {
        Vec2 raster;
        Rgb radiance;
    };
    /// The storage of one thread.
    struct Scratch {
        Subpath light_path;
        Subpath camera_path;
        PathWeigher weigher;
        std::vector<PendingSplat> splats;  ///< of the sample at work
        RenderStats stats;
    };
    /// The sample at work.
    struct Sample {
        std::int64_t index;
        Sampler& sampler;
        const Camera& camera;  // at its time
        const Films& films;
        Vec2 pixel;  // centre [pixels]
    };

    /// Which one it is.
    struct SampleId {
        int x;
        int y;
        std::int64_t index;
    };

    /// Makes one sample of a pixel. Here and below the probe is told what is being done.
    template <typename Probe>
    void add_sample(const SampleId& id, const Films& films, Scratch& scratch, Probe& probe) const;
    /// s <= 1: radiance that the camera path brings by itself.
    template <typename Probe>
    [[nodiscard]] Rgb estimate_camera_path(Sample& sample, Scratch& scratch, Probe& probe) const;
    /// s >= 2, t >= 2: radiance of the joins with the light path in `scratch`.
    template <typename Probe>
    [[nodiscard]] Rgb join_paths(const Sample& sample, Scratch& scratch, Probe& probe) const;
    /// t <= 1: what the light path in `scratch` brings to any pixel.
    template <typename Probe>
    void splat_light_path(Sample& sample, Scratch& scratch, Probe& probe) const;
    /// s = t = 1
    template <typename Probe>
    void splat_light(Sample& sample, Scratch& scratch, Probe& probe) const;
    /// What the path of a strategy counts in each channel: all alike unless it has met dispersion.
    [[nodiscard]] Rgb spectrum(Strategy strategy, const Sample& sample,
                               const Scratch& scratch) const;
    /// What `found`, which `scratch` has just weighed, counts in the pixel of the sample; notes it
    /// in the strategy's images.
    template <typename Probe>
    [[nodiscard]] Rgb measure(Strategy strategy, const Contribution& found, const Sample& sample,
                              Scratch& scratch, Probe& probe) const;
    /// The same for a splat; `dimension` tells those of one light path apart.
    template <typename Probe>
    void add_splat(Strategy strategy, const Splat& splat, std::uint32_t dimension, Sample& sample,
                   Scratch& scratch, Probe& probe) const;

    static void add_pending_splats(const Sample& sample, Scratch& scratch);

    const World& world_;
    const MovingCamera& camera_;
    RenderOptions options_;
    PixelFilter filter_;
    StrategySet strategies_;
};

}  // namespace bdpt
