#pragma once

#include "math/low_level.h"
#include "path/path_vertex.h"

#include <cstddef>
#include <memory>
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

/// Storage for one walk after another; it allocates only when it is constructed. Each tile
/// constructs some, and few walks are long, so nothing is written before a walk needs it.
class Subpath {
public:
    explicit Subpath(int max_vertices)
        : capacity_(static_cast<std::size_t>(max_vertices)),
          vertices_(room_for<PathVertex>(capacity_)),
          surfaces_(room_for<SurfacePoint>(capacity_ + 1))
    {
        crossings_.reserve(capacity_ + 1);
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
    [[nodiscard]] int capacity() const { return static_cast<int>(capacity_); }
    [[nodiscard]] PathVertex& operator[](int i) { return vertices_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] PathVertex& back() { return vertices_[size_ - 1]; }
    [[nodiscard]] std::span<const PathVertex> all() const { return first(size()); }
    [[nodiscard]] std::span<PathVertex> all() { return {vertices_.get(), size_}; }
    /// Returns the first `count` vertices.
    [[nodiscard]] std::span<const PathVertex> first(int count) const
    {
        return {vertices_.get(), static_cast<std::size_t>(count)};
    }

private:
    struct FreeRoom {
        void operator()(void* room) const { ::operator delete(room); }
    };
    template <typename T>
    using Room = std::unique_ptr<T[], FreeRoom>;
    template <typename T>
    [[nodiscard]] static Room<T> room_for(std::size_t count)
    {
        return Room<T>(static_cast<T*>(::operator new(count * sizeof(T))));
    }

    std::size_t capacity_;
    Room<PathVertex> vertices_;
    Room<SurfacePoint> surfaces_;  // surface of the vertex with the same index, and one more
    std::vector<LensCrossing> crossings_;
    std::size_t size_ = 0;
};

}  // namespace bdpt
