#pragma once

#include "scene/world.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace bdpt {

/// Squared distance [m^2] below which two vertices count as one point, where surfaces touch: no
/// walk goes on from there, for the densities would leave the range of float.
inline constexpr float coincident = 1e-30f;

enum class VertexKind : std::uint8_t {
    camera,   ///< on the lens
    light,    ///< where a light path starts, or a point found by next-event estimation
    surface,  ///< on a surface, which may emit
    medium,   ///< in a homogeneous medium, which scatters
    volume,   ///< in a volume, whose density varies: densities of walks leave its extinction out
    infinite  ///< on a light at infinity: `end.p` is the unit direction towards it
};

/// One vertex of a light or camera subpath. The `fwd` density is that of the walk which made the
/// vertex; the `rev` density is that of a walk which comes from the other end of the path.
struct PathVertex {
    SegmentEnd end;
    Rgb beta{1.0f};      ///< throughput of the subpath up to here, scattering not included
    Rgb emission{0.0f};  ///< radiance towards the previous vertex, of vertices that a camera walk
                         ///< found [nit]
    AreaPdf pdf_fwd;
    AreaPdf pdf_rev;
    AreaPdf pdf_next_event;  ///< of a light path's start: by next-event estimation from x_1
    /// Turns a density of directions at the next vertex into one of area here.
    float area_per_solid_angle = 1.0f;
    std::optional<LightId> light;
    Vec2 barycentrics{0.0f};  ///< of a point on a triangle light
    double sum = 0.0;         ///< of `WeightSums`
    VertexKind kind = VertexKind::surface;
    bool connectible = true;       ///< has a lobe that is not delta: strategies can join here
    bool scattered_delta = false;  ///< the walk left through a delta lobe
    bool dispersed = false;        ///< this vertex disperses, or one before it in the subpath
    float opacity = 1.0f;          ///< the share of rays that meet the surface
    const Bsdf* bsdf = nullptr;    ///< of what scatters; lives in the `Subpath`
};

static_assert(std::is_trivially_copyable_v<PathVertex> && sizeof(PathVertex) <= 120);

/// Does light change its direction at such a vertex, by its `bsdf`?
[[nodiscard]] constexpr bool scatters(VertexKind kind)
{
    return kind == VertexKind::surface || kind == VertexKind::medium || kind == VertexKind::volume;
}

/// Can a strategy join at this vertex, which lies inside of a subpath?
[[nodiscard]] inline bool joinable(const PathVertex& vertex)
{
    return !scatters(vertex.kind) || (vertex.connectible && !vertex.scattered_delta);
}

/// |cos| of a direction at the end of a segment; 1 where there is no surface to be foreshortened.
[[nodiscard]] inline float abs_cosine(const SegmentEnd& end, Vec3 w)
{
    return end.ng == Vec3(0.0f) ? 1.0f : std::abs(dot(end.ng, w));
}

/// Probability that a walk reaches the vertex along this segment; a factor of its density.
[[nodiscard]] inline float pdf_of_end(const PathVertex& vertex,
                                      const SegmentTransmission& transmission)
{
    return transmission.pdf_of_end(vertex.kind == VertexKind::medium);
}

}  // namespace bdpt
