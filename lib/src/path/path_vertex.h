#pragma once

#include "scene/world.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace bdpt {

/// Squared distance [m^2] below which two vertices count as one point, where surfaces touch: walks
/// end there, as the densities would exceed the range of float.
inline constexpr float coincident = 1e-30f;

enum class VertexKind : std::uint8_t {
    camera,   ///< point on the lens
    light,    ///< start of a light path, or a point sampled by next-event estimation
    surface,  ///< point on a surface, which may emit
    medium,   ///< scattering event in a homogeneous medium
    /// Scattering event in a heterogeneous volume: densities of walks exclude its extinction.
    volume,
    infinite  ///< point on a light at infinity: `end.p` is the unit direction towards it
};

/// A vertex of a light or camera subpath. The `fwd` density is that of the walk that sampled the
/// vertex; the `rev` density is that of a walk from the other end of the path.
struct PathVertex {
    SegmentEnd end;
    Rgb beta{1.0f};      ///< throughput of the subpath up to this vertex, excluding its scattering
    Rgb emission{0.0f};  ///< camera walks: radiance emitted towards the previous vertex [nit]
    AreaPdf pdf_fwd;
    AreaPdf pdf_rev;
    AreaPdf pdf_next_event;  ///< start of a light path: density of next-event estimation from x_1
    /// Converts a density of directions at the next vertex to an area density here.
    float area_per_solid_angle = 1.0f;
    std::optional<LightId> light;
    Vec2 barycentrics{0.0f};  ///< barycentric coordinates on a triangle light
    /// Sum of `WeightSums` over the strategies that move this vertex alone to the other subpath.
    double sum_of_one = 0.0;
    /// Likewise over those that move its predecessor, too, for a density of one of that vertex.
    double sum_of_more = 0.0;
    VertexKind kind = VertexKind::surface;
    bool connectible = true;       ///< has a lobe that is not delta: strategies can connect here
    bool scattered_delta = false;  ///< the walk left through a delta lobe
    bool dispersed = false;        ///< this vertex or a previous one of the subpath disperses
    float opacity = 1.0f;          ///< fraction of rays that hit the surface
    const Bsdf* bsdf = nullptr;    ///< BSDF or phase function of the vertex; lives in the `Subpath`
};

static_assert(std::is_trivially_copyable_v<PathVertex> && sizeof(PathVertex) <= 128);

/// Tests whether vertices of this kind scatter light by their `bsdf`.
[[nodiscard]] constexpr bool scatters(VertexKind kind)
{
    return kind == VertexKind::surface || kind == VertexKind::medium || kind == VertexKind::volume;
}

/// Tests whether a strategy can connect at this interior vertex of a subpath.
[[nodiscard]] inline bool joinable(const PathVertex& vertex)
{
    return !scatters(vertex.kind) || (vertex.connectible && !vertex.scattered_delta);
}

/// Returns |cos| of a direction at the end of a segment; 1 if the end is not on a surface.
[[nodiscard]] inline float abs_cosine(const SegmentEnd& end, Vec3 w)
{
    return end.ng == Vec3(0.0f) ? 1.0f : std::abs(dot(end.ng, w));
}

/// Returns the probability that a walk reaches the vertex along this segment; a factor of its
/// density.
[[nodiscard]] inline float pdf_of_end(const PathVertex& vertex,
                                      const SegmentTransmission& transmission)
{
    return transmission.pdf_of_end(vertex.kind == VertexKind::medium);
}

}  // namespace bdpt
