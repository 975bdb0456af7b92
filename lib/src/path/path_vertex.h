#pragma once

#include "scene/world.h"

#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace bdpt {

/// Squared distance [m^2] below which two vertices count as one point, where surfaces touch: no
/// walk goes on from there, for the densities would leave the range of float.
inline constexpr float coincident = 1e-30f;

enum class VertexKind : std::uint8_t {
    camera,   ///< on the lens
    light,    ///< where a light path starts, or a point found by next-event estimation
    surface,  ///< on a surface, which may emit
    infinite  ///< on a light at infinity: `end.p` is the unit direction towards it
};

/// One vertex of a light or camera subpath. The `fwd` density is that of the walk which made the
/// vertex; the `rev` density is that of a walk which comes from the other end of the path.
struct PathVertex {
    SegmentEnd end;
    Rgb beta{1.0f};      ///< Monte Carlo weight of the subpath up to here, scattering not included
    Rgb emission{0.0f};  ///< radiance towards the previous vertex, of vertices that a camera walk
                         ///< found [nit]
    AreaPdf pdf_fwd;
    AreaPdf pdf_rev;
    AreaPdf pdf_next_event;  ///< of a light path's start: by next-event estimation from x_1
    /// Turns a density of directions at the next vertex into one of area here.
    float area_per_solid_angle = 1.0f;
    std::optional<LightId> light;
    Vec2 barycentrics{0.0f};  ///< of a point on a triangle light
    VertexKind kind = VertexKind::surface;
    bool connectible = true;       ///< has a lobe that is not delta: strategies can join here
    bool scattered_delta = false;  ///< the walk left through a delta lobe
    bool dispersed = false;        ///< this vertex disperses, or one before it in the subpath
    Bsdf bsdf;                     ///< of surfaces
};

static_assert(std::is_trivially_copyable_v<PathVertex>);

/// A light walk met the lens, which stops nobody, on its way from its last vertex at that time.
struct LensCrossing {
    int light_vertices = 0;  ///< of the walk before the lens
    PathVertex lens;
    Vec2 raster{0.0f};
    float importance = 0.0f;      ///< We
    AreaPdf camera_at_light_end;  ///< the walk's last vertex sampled from the lens
};

/// Storage for one walk after another; it allocates only when it is made.
class Subpath {
public:
    explicit Subpath(int max_vertices) : vertices_(static_cast<std::size_t>(max_vertices))
    {
        crossings_.reserve(vertices_.size() + 1);
    }

    void clear()
    {
        size_ = 0;
        crossings_.clear();
        rays_ = 0;
    }
    void count_ray() { ++rays_; }
    /// Rays that the walk has followed.
    [[nodiscard]] std::uint64_t rays() const { return rays_; }
    /// A vertex with default values at the end. There must be room.
    PathVertex& append()
    {
        PathVertex& vertex = vertices_[size_++];
        vertex = PathVertex{};
        return vertex;
    }
    void add_crossing(const LensCrossing& crossing) { crossings_.push_back(crossing); }
    [[nodiscard]] std::span<const LensCrossing> crossings() const { return crossings_; }
    [[nodiscard]] int size() const { return static_cast<int>(size_); }
    [[nodiscard]] int capacity() const { return static_cast<int>(vertices_.size()); }
    [[nodiscard]] PathVertex& operator[](int i) { return vertices_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] std::span<const PathVertex> all() const { return first(size()); }
    /// The first `count` vertices.
    [[nodiscard]] std::span<const PathVertex> first(int count) const
    {
        return std::span(vertices_).first(static_cast<std::size_t>(count));
    }

private:
    std::vector<PathVertex> vertices_;
    std::vector<LensCrossing> crossings_;
    std::size_t size_ = 0;
    std::uint64_t rays_ = 0;
};

}  // namespace bdpt
