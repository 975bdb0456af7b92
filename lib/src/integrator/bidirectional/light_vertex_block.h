#pragma once

#include "math/low_level.h"
#include "path/path_vertex.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace bdpt {

/// What the choice of connections needs to know of four vertices of light paths.
struct LightVertexBlock {
    static constexpr std::size_t size = 4;

    Float4 x, y, z;           ///< position [m]
    Float4 nx, ny, nz;        ///< normal if the vertex scatters on one side of it only; else zero
    Float4 any_side;          ///< 1 if the vertex scatters to all sides; else 0
    Float4 red, green, blue;  ///< `estimated_power` of the vertex; 0 if there is none
    Float4 area;              ///< `nearby_area` of the vertex [m^2]
    Int4 s;                   ///< number of vertices of the light path up to this one
    std::array<std::uint32_t, size> path_begin;  ///< index of the path's first vertex in its chunk
    std::array<std::uint32_t, size> path;        ///< number of the light path in its bundle

    /// Fills entry `i` with the last of the path's first `s` vertices. `count` is the mean number
    /// of light paths that a camera path is connected to.
    void set(std::size_t i, std::span<const PathVertex> light, double count);
};

/// Tests whether a connection can be chosen at this vertex of a light or camera path.
[[nodiscard]] inline bool can_choose(const PathVertex& vertex)
{
    return scatters(vertex.kind) && vertex.connectible;
}

/// Returns the throughput of the scattered light if the base colour is the albedo; a dielectric
/// with a black base reflects some light, too.
[[nodiscard]] Rgb estimated_power(const PathVertex& vertex);

/// Returns 1 / (pi count pdf) for the last vertex of a subpath, where `pdf` is its density [1/m^2].
/// If two connected vertices are nearer to each other than the root of this area, a walk from the
/// other side finds the vertex more often than `count` connections do, and has most of the MIS
/// weight. 0 if no strategy does without the vertex's own walk.
[[nodiscard]] float nearby_area(std::span<const PathVertex> subpath, double count);

}  // namespace bdpt
