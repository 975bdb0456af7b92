#pragma once

#include "math/blank.h"
#include "path/path_vertex.h"

#include <cstddef>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

namespace bdpt {

/// Crossing of the aperture by the light subpath on its way from its last vertex at that time; the
/// aperture does not block it.
struct LensCrossing {
    int light_vertices = 0;  ///< vertices of the walk before the lens
    PathVertex lens;
    Vec2 raster{0.0f};
    float importance = 0.0f;      ///< importance We
    AreaPdf camera_at_light_end;  ///< density of sampling the walk's last vertex from the lens
};

static_assert(std::is_trivially_copyable_v<SurfacePoint>);

/// Storage for one walk after another; it allocates only when it is constructed.
class Subpath {
public:
    explicit Subpath(int max_vertices)
        : vertices_(static_cast<std::size_t>(max_vertices)), surfaces_(vertices_.size() + 1)
    {
        crossings_.reserve(vertices_.size() + 1);
    }

    void clear()
    {
        size_ = 0;
        crossings_.clear();
    }
    /// Appends a vertex with default values. Requires `size()` < `capacity()`.
    PathVertex& append()
    {
        PathVertex& vertex = vertices_[size_++];
        vertex = blank<PathVertex>;
        return vertex;
    }
    /// Constructs the surface of the next vertex in place by `make()`. There must be room.
    template <typename Make>
    const SurfacePoint& emplace_surface(const Make& make)
    {
        return *::new (&surfaces_[size_]) SurfacePoint(make());
    }
    void add_crossing(const LensCrossing& crossing) { crossings_.push_back(crossing); }
    [[nodiscard]] std::span<const LensCrossing> crossings() const { return crossings_; }
    [[nodiscard]] int size() const { return static_cast<int>(size_); }
    [[nodiscard]] int capacity() const { return static_cast<int>(vertices_.size()); }
    [[nodiscard]] PathVertex& operator[](int i) { return vertices_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] PathVertex& back() { return vertices_[size_ - 1]; }
    [[nodiscard]] std::span<const PathVertex> all() const { return first(size()); }
    [[nodiscard]] std::span<PathVertex> all() { return std::span(vertices_).first(size_); }
    /// Returns the first `count` vertices.
    [[nodiscard]] std::span<const PathVertex> first(int count) const
    {
        return std::span(vertices_).first(static_cast<std::size_t>(count));
    }

private:
    std::vector<PathVertex> vertices_;
    std::vector<SurfacePoint> surfaces_;  // surface of the vertex with the same index, and one more
    std::vector<LensCrossing> crossings_;
    std::size_t size_ = 0;
};

}  // namespace bdpt
