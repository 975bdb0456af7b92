#include "integrator/bidirectional/connection_chooser.h"

#include "path/strategy_set.h"

#include <cmath>
#include <cstddef>

namespace bdpt {
namespace {

// Estimates may be wrong, where BSDFs are glossy or MIS weights are unusual. So some connections
// are divided evenly among the camera vertices, and some among all pairs of vertices. The latter
// bound the scale of a connection.
constexpr float share_of_camera_vertices = 0.3f;
constexpr float share_of_pairs = 0.1f;
constexpr float share_of_estimates = 1.0f - share_of_camera_vertices - share_of_pairs;

}  // namespace

ConnectionChooser::ConnectionChooser(const RenderOptions& options)
    : rays_(static_cast<float>(options.bidirectional.connection_rays)),
      light_paths_(LightPathCounts(options).connections),
      max_vertices_(options.transport.max_depth + 1)
{}

std::span<const ConnectionChooser::Connection> ConnectionChooser::choose(
    const Subpath& camera, std::span<const LightVertexBlock> light, float u)
{
    chosen_.clear();
    estimate_all(camera, light);
    float total = 0.0f;
    float pairs = 0.0f;
    for (const CameraVertex& vertex : vertices_) {
        total += vertex.all.sum;
        pairs += vertex.all.number;
    }
    if (vertices_.empty()) {
        return {};
    }
    const float by_estimate = share_of_estimates * rays_ / total;
    const float of_vertex = share_of_camera_vertices * rays_ / static_cast<float>(vertices_.size());
    const float of_pair = share_of_pairs * rays_ / pairs;
    // Systematic sampling: where the running sum of the expected numbers passes a whole number,
    // that connection is chosen.
    float running = u;
    const BlockEstimates* next = blocks_.data();
    for (const CameraVertex& vertex : vertices_) {
        const float rate = by_estimate + of_vertex / vertex.all.sum;
        for (const LightVertexBlock& block : light) {
            const BlockEstimates& estimates = *next++;
            const float of_block = estimates.all.sum * rate + estimates.all.number * of_pair;
            if (running + of_block < 1.0f) {
                running += of_block;
                continue;
            }
            for (std::size_t i = 0; i < LightVertexBlock::size; ++i) {
                if (!(estimates.of_vertices[i] > 0.0f)) {
                    continue;
                }
                const float expected = estimates.of_vertices[i] * rate + of_pair;
                running += expected;
                if (running < 1.0f) {
                    continue;
                }
                const float times = std::floor(running);
                running -= times;
                chosen_.push_back({.s = block.s[i],
                                   .t = vertex.t,
                                   .path_begin = block.path_begin[i],
                                   .path = block.path[i],
                                   .scale = times / expected,
                                   .chance = expected});
            }
        }
    }
    return chosen_;
}

void ConnectionChooser::estimate_all(const Subpath& camera, std::span<const LightVertexBlock> light)
{
    vertices_.clear();
    blocks_.clear();
    for (int t = 2; t <= camera.size(); ++t) {
        const auto prefix = camera.first(t);
        const PathVertex& z = prefix.back();
        if (!can_choose(z)) {
            continue;
        }
        const std::size_t before = blocks_.size();
        const Estimates all = estimate(prefix, light);
        if (all.number > 0.0f) {
            vertices_.push_back({.t = t, .all = all});
        } else {
            blocks_.resize(before);
        }
    }
}

ConnectionChooser::Estimates ConnectionChooser::estimate(std::span<const PathVertex> camera,
                                                         std::span<const LightVertexBlock> light)
{
    constexpr Float4 zero{};
    constexpr Float4 one{1.0f, 1.0f, 1.0f, 1.0f};
    // Limits of estimates, whatever the size of the scene is and the power of its lights: sums and
    // rates are finite, and no connection that may bring light is lost.
    constexpr Float4 least = 1e-34f * one;
    constexpr Float4 most = 1e30f * one;
    const auto t = static_cast<int>(camera.size());
    const PathVertex& end = camera.back();
    const Vec3 p = end.end.p;
    const auto normal = end.bsdf->opaque_normal();
    const Vec3 n = normal.value_or(Vec3(0.0f));
    const float any_side = normal ? 0.0f : 1.0f;
    // Splats, which find the first vertex of a camera path without its walk, are not considered.
    const Rgb power = estimated_power(end);
    const float area = t == 2 ? 0.0f : nearby_area(camera, light_paths_);
    Float4 sums{};
    Float4 numbers{};
    for (const LightVertexBlock& block : light) {
        const Float4 x = block.x - p.x;
        const Float4 y = block.y - p.y;
        const Float4 z = block.z - p.z;
        const Float4 squared = x * x + y * y + z * z + coincident;
        const Float4 distance = square_root(squared);
        // Cosines times the distance.
        const Float4 at_camera = positive_part(x * n.x + y * n.y + z * n.z + any_side * distance);
        const Float4 at_light =
            positive_part(block.any_side * distance - (x * block.nx + y * block.ny + z * block.nz));
        const Float4 cosines = at_camera * at_light / squared;
        const Float4 both = block.red * power.x + block.green * power.y + block.blue * power.z;
        const Float4 value = both * cosines / (squared + cosines * (block.area + area));
        const Float4 limited = value < most ? (value > least ? value : least) : most;
        const Int4 possible =
            (at_camera > 0.0f) & (at_light > 0.0f) & (both > 0.0f) & (block.s <= max_vertices_ - t);
        const Float4 estimates = possible ? limited : zero;
        const Float4 counts = estimates > 0.0f ? one : zero;
        blocks_.push_back(
            {.of_vertices = estimates, .all = {.sum = sum(estimates), .number = sum(counts)}});
        sums += estimates;
        numbers += counts;
    }
    return {.sum = sum(sums), .number = sum(numbers)};
}

}  // namespace bdpt
