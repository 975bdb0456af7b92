#pragma once

#include "math/blank.h"
#include "path/path_vertex.h"

#include <cstddef>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

namespace bdpt {

/// The light subpath crosses the aperture on its way from its last vertex at that time; the
/// aperture does not block it.
struct LensCrossing {
    int light_vertices = 0;  ///< of the walk before the lens
    PathVertex lens;
    Vec2 raster{0.0f};
    float importance = 0.0f;      ///< We
    AreaPdf camera_at_light_end;  ///< the walk's last vertex sampled from the lens
};

static_assert(std::is_trivially_copyable_v<SurfacePoint>);

/// Storage for one walk after another; it allocates only when it is made.
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
    /// A vertex with default values at the end. There must be room.
    PathVertex& append()
    {
        PathVertex& vertex = vertices_[size_++];
        vertex = blank<PathVertex>;
        return vertex;
    }
    /// Where the surface of the next vertex is put by `make()`, without a copy. There must be room.
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
    /// The first `count` vertices.
    [[nodiscard]] std::span<const PathVertex> first(int count) const
    {
        return std::span(vertices_).first(static_cast<std::size_t>(count));
    }

private:
    std::vector<PathVertex> vertices_;
    std::vector<SurfacePoint> surfaces_;  // of the vertex with the same number, and one more
    std::vector<LensCrossing> crossings_;
    std::size_t size_ = 0;
};

}  // namespace bdpt
