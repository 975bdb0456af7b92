#pragma once

#include "integrator/bidirectional/light_path_cache.h"
#include "path/subpath.h"

#include <bdpt/render_options.h>

#include <cstdint>
#include <span>
#include <vector>

namespace bdpt {

/// Chooses some of the connections between a camera path and the vertices of its light paths
/// [cf. Popov et al. 2015, "Probabilistic Connections for Bidirectional Path Tracing"]. The
/// probability of each is proportional to an estimate of its contribution: throughputs, base
/// colours in place of BSDFs, and cosines over the squared distance, times the approximate MIS
/// weight, without visibility. An estimate costs a hundredth of a connection. For one thread.
class ConnectionChooser {
public:
    /// The connection of the first `s` vertices of a light path with the first `t` of the camera
    /// path. Its contribution times `scale` is an estimate of the sum over all connections.
    struct Connection {
        int s;
        int t;
        std::uint32_t path_begin;  ///< as in `LightVertexBlock`
        std::uint32_t path;
        float scale;
        float chance;  ///< expected number of times that it is chosen
    };

    /// `options` have been checked.
    explicit ConnectionChooser(const RenderOptions& options);

    /// Returns the chosen connections, about `BidirectionalOptions::connection_rays` in number,
    /// sorted by t. `u` is a random number. Valid until the next call.
    [[nodiscard]] std::span<const Connection> choose(const Subpath& camera,
                                                     std::span<const LightVertexBlock> light,
                                                     float u);

private:
    /// Sum and number of estimates above 0.
    struct Estimates {
        float sum = 0.0f;
        float number = 0.0f;
    };
    struct BlockEstimates {
        Float4 of_vertices;
        Estimates all;
    };
    /// A vertex of the camera path that has connections.
    struct CameraVertex {
        int t;
        Estimates all;
    };

    void estimate_all(const Subpath& camera, std::span<const LightVertexBlock> light);
    /// Appends the estimates of all blocks with the end of `camera`. Returns their sums.
    [[nodiscard]] Estimates estimate(std::span<const PathVertex> camera,
                                     std::span<const LightVertexBlock> light);

    float rays_;
    double light_paths_;  ///< number of those that a camera path is connected to
    int max_vertices_;
    std::vector<CameraVertex> vertices_;
    std::vector<BlockEstimates> blocks_;  ///< all with the first of `vertices_`, then the next
    std::vector<Connection> chosen_;
};

}  // namespace bdpt
