#include "render/ground/ground_occluders.h"

#include "math/elementary.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A horizontal rectangle.
struct Rectangle {
    double x0 = infinity;
    double z0 = infinity;
    double x1 = -infinity;
    double z1 = -infinity;

    [[nodiscard]] bool contains_origin() const
    {
        return x0 <= 0.0 && x1 >= 0.0 && z0 <= 0.0 && z1 >= 0.0;
    }
};

/// An upright box; heights are above the ground.
struct Block {
    Rectangle base;
    double bottom = infinity;
    double top = -infinity;

    [[nodiscard]] bool is_empty() const { return !(top > 0.0); }
    void add(const Block& other)
    {
        base = {std::min(base.x0, other.base.x0), std::min(base.z0, other.base.z0),
                std::max(base.x1, other.base.x1), std::max(base.z1, other.base.z1)};
        bottom = std::min(bottom, other.bottom);
        top = std::max(top, other.top);
    }
    void add(Vec3 p, double ground)
    {
        const auto x = static_cast<double>(p.x);
        const auto z = static_cast<double>(p.z);
        const double y = static_cast<double>(p.y) - ground;
        base = {std::min(base.x0, x), std::min(base.z0, z), std::max(base.x1, x),
                std::max(base.z1, z)};
        bottom = std::min(bottom, y);
        top = std::max(top, y);
    }
    void add(Vec3 p, float radius, double ground)
    {
        add(p - radius, ground);
        add(p + radius, ground);
    }
};

/// Calls `visit(block)` for blocks that contain all surfaces: of triangles if they are few enough
/// to process quickly, else of whole instances.
template <typename Visit>
void for_each_block(const SceneGeometry& geometry, double ground, const Visit& visit)
{
    constexpr std::size_t max_corners = 6'000'000;
    std::size_t corners = 0;
    for (const PlacedMesh& mesh : geometry.placed) {
        corners += 3 * mesh.mesh().triangles.size() * (mesh.steps() + 1);
    }
    for (std::size_t i = 0; i < geometry.placed.size(); ++i) {
        const PlacedMesh& mesh = geometry.placed[i];
        const auto& box = geometry.boxes[static_cast<std::size_t>(geometry.instances[i].mesh)];
        if (!box) {
            continue;
        }
        if (corners > max_corners && !mesh.deforms()) {
            Block block;
            for (std::size_t step = 0; step <= mesh.steps(); ++step) {
                const Placement at(mesh.transform_at(step));
                for (int corner = 0; corner < 8; ++corner) {
                    const Vec3 sign((corner & 1) != 0 ? 1.0f : -1.0f,
                                    (corner & 2) != 0 ? 1.0f : -1.0f,
                                    (corner & 4) != 0 ? 1.0f : -1.0f);
                    block.add(at.point(box->center + sign * box->half), ground);
                }
            }
            visit(block);
            continue;
        }
        for (const UVec3& triangle : mesh.mesh().triangles) {
            Block block;
            for (int corner = 0; corner < 3; ++corner) {
                for (std::size_t step = 0; step <= mesh.steps(); ++step) {
                    block.add(mesh.world_point_at(step, triangle[corner]), ground);
                }
            }
            visit(block);
        }
    }
    for (const Sphere& sphere : geometry.spheres) {
        Block block;
        block.add(sphere.center, sphere.radius, ground);
        for (const Vec3& center : sphere.motion) {
            block.add(center, sphere.radius, ground);
        }
        visit(block);
    }
}

/// The scene in columns, and in ever larger squares of them: at level l, `side` / 2^l in x and z.
struct Pyramid {
    static constexpr std::size_t side = 64;
    static constexpr std::size_t levels = 5;
    std::array<std::vector<Block>, levels> blocks;
};

/// Partition of the scene into columns, each from the lowest to the highest surface in it.
class Columns {
public:
    Columns(const Rectangle& base, double margin) : base_(base), margin_(margin) {}

    void add(const Block& block)
    {
        const auto [x0, x1] = cells(block.base.x0, block.base.x1, base_.x0, base_.x1);
        const auto [z0, z1] = cells(block.base.z0, block.base.z1, base_.z0, base_.z1);
        for (std::size_t z = z0; z <= z1; ++z) {
            for (std::size_t x = x0; x <= x1; ++x) {
                // Adds only the part of the block within the column, as most are smaller than it.
                Block& column = columns_[z * side + x];
                column.base.x0 = std::min(column.base.x0, std::max(block.base.x0, edge_x(x)));
                column.base.x1 = std::max(column.base.x1, std::min(block.base.x1, edge_x(x + 1)));
                column.base.z0 = std::min(column.base.z0, std::max(block.base.z0, edge_z(z)));
                column.base.z1 = std::max(column.base.z1, std::min(block.base.z1, edge_z(z + 1)));
                column.bottom = std::min(column.bottom, block.bottom);
                column.top = std::max(column.top, block.top);
            }
        }
    }
    /// Returns the occluders above the ground, with a margin for rounding, by level: columns, then
    /// squares of 2 x 2 of the previous level.
    [[nodiscard]] Pyramid pyramid() const
    {
        Pyramid result;
        for (std::size_t level = 0; level < Pyramid::levels; ++level) {
            const std::size_t width = Pyramid::side >> level;
            result.blocks[level].resize(width * width);
            for (std::size_t z = 0; z < Pyramid::side; ++z) {
                for (std::size_t x = 0; x < Pyramid::side; ++x) {
                    const Block& column = columns_[z * Pyramid::side + x];
                    if (!(column.top + margin_ > 0.0)) {
                        continue;
                    }
                    result.blocks[level][(z >> level) * width + (x >> level)].add(
                        {.base = {column.base.x0 - margin_, column.base.z0 - margin_,
                                  column.base.x1 + margin_, column.base.z1 + margin_},
                         .bottom = column.bottom - margin_,
                         .top = column.top + margin_});
                }
            }
        }
        return result;
    }

private:
    static constexpr std::size_t side = Pyramid::side;

    [[nodiscard]] static std::array<std::size_t, 2> cells(double from, double to, double begin,
                                                          double end)
    {
        const double scale = end > begin ? static_cast<double>(side) / (end - begin) : 0.0;
        const auto cell = [&](double at) {
            return static_cast<std::size_t>(
                std::clamp(scale * (at - begin), 0.0, static_cast<double>(side - 1)));
        };
        return {cell(from), cell(to)};
    }
    [[nodiscard]] double edge_x(std::size_t x) const { return edge(base_.x0, base_.x1, x); }
    [[nodiscard]] double edge_z(std::size_t z) const { return edge(base_.z0, base_.z1, z); }
    [[nodiscard]] static double edge(double begin, double end, std::size_t i)
    {
        return begin + (end - begin) * static_cast<double>(i) / static_cast<double>(side);
    }

    Rectangle base_;
    double margin_;
    std::vector<Block> columns_{side * side};
};

/// Azimuth and distance of an occluder, seen from anywhere in a place: azimuths from `from` on, in
/// strips, over `width` strips.
struct Sector {
    double from = 0.0;
    double width = static_cast<double>(GroundOccluders::strips);
    double nearest_squared = 0.0;   // [m^2]
    double farthest_squared = 0.0;  // [m^2]
};

Sector find_sector(const Rectangle& r)
{
    Sector result;
    const auto length_squared = [](double x, double z) { return x * x + z * z; };
    result.farthest_squared = length_squared(std::max(-r.x0, r.x1), std::max(-r.z0, r.z1));
    if (r.contains_origin()) {
        return result;
    }
    result.nearest_squared =
        length_squared(std::max({r.x0, 0.0, -r.x1}), std::max({r.z0, 0.0, -r.z1}));
    // The rectangle is on one side of a line through the origin, so the first and the last azimuth,
    // in ascending order, are at corners.
    const double near_x = r.x0 > 0.0 ? r.x0 : r.x1;  // if it extends to both sides in z
    const double near_z = r.z0 > 0.0 ? r.z0 : r.z1;
    const auto azimuth = [](double x, double z) {
        return static_cast<double>(
            GroundOccluders::azimuth(static_cast<float>(x), static_cast<float>(z)));
    };
    result.from = azimuth(r.z0 > 0.0   ? r.x0
                          : r.z1 < 0.0 ? r.x1
                                       : near_x,
                          r.x0 > 0.0   ? r.z1
                          : r.x1 < 0.0 ? r.z0
                                       : near_z);
    const double last = azimuth(r.z0 > 0.0   ? r.x1
                                : r.z1 < 0.0 ? r.x0
                                             : near_x,
                                r.x0 > 0.0   ? r.z0
                                : r.x1 < 0.0 ? r.z1
                                             : near_z);
    result.width = last - result.from;
    result.width += result.width < 0.0 ? static_cast<double>(GroundOccluders::strips) : 0.0;
    return result;
}

/// Exceeds the rounding of angles, in strips and rows.
constexpr double rounding = 1e-3;

/// Returns the row of a polar angle by the square of its sine.
double row_at(double sine_squared)
{
    constexpr double rows = GroundOccluders::rows;
    return rows * 2.0 * static_cast<double>(inv_pi) *
           static_cast<double>(
               atan2_exact(static_cast<float>(std::sqrt(sine_squared)),
                           static_cast<float>(std::sqrt(std::max(1.0 - sine_squared, 0.0)))));
}

/// Finds the directions that the scene may block, seen from anywhere in a place.
class View {
public:
    View(const Pyramid& scene, const Rectangle& place) : scene_(scene), place_(place) {}

    [[nodiscard]] GroundOccluders::Skyline find()
    {
        constexpr std::size_t top = Pyramid::levels - 1;
        constexpr std::size_t width = Pyramid::side >> top;
        for (std::size_t i = 0; i < width * width; ++i) {
            look_at(top, i % width, i / width);
        }
        constexpr double rows = GroundOccluders::rows;
        GroundOccluders::Skyline skyline;
        for (std::size_t i = 0; i < strips_.size(); ++i) {
            if (strips_[i].first <= strips_[i].last) {
                skyline[i].begin = static_cast<std::uint8_t>(
                    std::clamp(row_at(strips_[i].first) - rounding, 0.0, rows - 1.0));
                skyline[i].end = static_cast<std::uint8_t>(
                    std::ceil(std::clamp(row_at(strips_[i].last) + rounding, 1.0, rows)));
            }
        }
        return skyline;
    }

private:
    /// Squared sines of the polar angles that are blocked. In a strip the projected solid angle of
    /// an interval is proportional to their difference.
    struct Strip {
        double first = 2.0;
        double last = -1.0;
    };

    /// Adds a block, or parts of it where that makes a difference: the nearest first, as they often
    /// cover the others.
    void look_at(std::size_t level, std::size_t x, std::size_t z)
    {
        const Block& block = scene_.blocks[level][z * (Pyramid::side >> level) + x];
        if (block.is_empty()) {
            return;
        }
        const Sector sector = find_sector({block.base.x0 - place_.x1, block.base.z0 - place_.z1,
                                           block.base.x1 - place_.x0, block.base.z1 - place_.z0});
        const auto sine_squared = [](double distance_squared, double height) {
            return height > 0.0 ? distance_squared / (distance_squared + height * height) : 1.0;
        };
        const double first = sine_squared(sector.nearest_squared, block.top);
        const double last = sine_squared(sector.farthest_squared, block.bottom);
        constexpr auto strips = static_cast<std::int64_t>(GroundOccluders::strips);
        const auto begin = static_cast<std::int64_t>(std::floor(sector.from - rounding));
        const auto end =
            std::min(static_cast<std::int64_t>(std::ceil(sector.from + sector.width + rounding)),
                     begin + strips);
        const auto strip = [&](std::int64_t i) -> Strip& {
            return strips_[static_cast<std::size_t>((i + strips) % strips)];
        };
        double more = 0.0;  // that the block as a whole would cover
        for (std::int64_t i = begin; i < end; ++i) {
            more = std::max({more, strip(i).first - first, last - strip(i).last});
        }
        constexpr double little = 0.02;
        constexpr double narrow = 1.0;  // strips
        if (level == 0 || more <= little || sector.width < narrow) {
            for (std::int64_t i = begin; i < end; ++i) {
                strip(i) = {std::min(strip(i).first, first), std::max(strip(i).last, last)};
            }
            return;
        }
        const bool is_east = place_.x0 + place_.x1 > block.base.x0 + block.base.x1;
        const bool is_south = place_.z0 + place_.z1 > block.base.z0 + block.base.z1;
        const std::size_t nearest = (is_east ? 1U : 0U) + (is_south ? 2U : 0U);
        for (const std::size_t part : {nearest, nearest ^ 1U, nearest ^ 2U, nearest ^ 3U}) {
            look_at(level - 1, 2 * x + (part & 1U), 2 * z + (part >> 1U));
        }
    }

    const Pyramid& scene_;
    const Rectangle& place_;
    std::array<Strip, GroundOccluders::strips> strips_{};
};

}  // namespace

float GroundOccluders::azimuth(float x, float z)
{
    const float turns = atan2_exact(x, z) * (0.5f * inv_pi);
    return static_cast<float>(strips) * (turns < 0.0f ? turns + 1.0f : turns);
}

GroundOccluders::GroundOccluders(const SceneGeometry& geometry, float height)
{
    const auto ground = static_cast<double>(height);
    Block all;
    for_each_block(geometry, ground, [&](const Block& block) {
        if (!block.is_empty()) {
            all.add(block);
        }
    });
    if (all.is_empty()) {
        return;
    }
    const Rectangle& base = all.base;
    const double half = 0.5 * std::max({base.x1 - base.x0, base.z1 - base.z0, all.top});
    const double farthest = std::max({std::abs(base.x0), std::abs(base.x1), std::abs(base.z0),
                                      std::abs(base.z1), all.top, std::abs(ground)});
    // Ray origins are offset from their points, and points on surfaces are rounded.
    Columns columns(base, 1e-4 * half + 1e-5 * farthest);
    for_each_block(geometry, ground, [&](const Block& block) {
        if (!block.is_empty()) {
            columns.add(block);
        }
    });
    center_ = {static_cast<float>(0.5 * (base.x0 + base.x1)),
               static_cast<float>(0.5 * (base.z0 + base.z1))};
    reach_ = static_cast<float>(half);
    const Pyramid scene = columns.pyramid();
    // The edges of places are those of `place`, slightly enlarged.
    const auto edge = [&](std::size_t i, float center) {
        constexpr double far_away = 1e18;
        const double m = 2.0 * static_cast<double>(i) / static_cast<double>(side) - 1.0;
        const double u = std::abs(m) < 1.0 ? m / (1.0 - std::abs(m)) : std::copysign(far_away, m);
        return static_cast<double>(center) + u * half;
    };
    skylines_.resize(side * side);
    tbb::parallel_for(std::size_t{0}, side, [&](std::size_t z) {
        for (std::size_t x = 0; x < side; ++x) {
            Rectangle place{edge(x, center_.x), edge(z, center_.y), edge(x + 1, center_.x),
                            edge(z + 1, center_.y)};
            const double more = 1e-4 * half + 1e-5 * farthest;
            place = {place.x0 - more - 1e-5 * std::abs(place.x0),
                     place.z0 - more - 1e-5 * std::abs(place.z0),
                     place.x1 + more + 1e-5 * std::abs(place.x1),
                     place.z1 + more + 1e-5 * std::abs(place.z1)};
            skylines_[z * side + x] = View(scene, place).find();
        }
    });
}

std::size_t GroundOccluders::place(Vec3 p) const
{
    const auto cell = [this](float at) {
        const float u = at / reach_;
        const float m = u / (1.0f + std::abs(u));
        constexpr float half = 0.5f * static_cast<float>(side);
        return static_cast<std::size_t>(
            std::clamp(half + half * m, 0.0f, static_cast<float>(side - 1)));
    };
    return cell(p.z - center_.y) * side + cell(p.x - center_.x);
}

Vec2 GroundOccluders::point(std::size_t place, Vec2 within) const
{
    const auto at = [this](float cell) {
        constexpr float most = 0.98f;
        const float m = std::clamp(2.0f * cell / static_cast<float>(side) - 1.0f, -most, most);
        return reach_ * m / (1.0f - std::abs(m));
    };
    return center_ + Vec2(at(static_cast<float>(place % side) + within.x),
                          at(static_cast<float>(place / side) + within.y));
}

bool GroundOccluders::may_block(std::size_t place, Vec3 to_light) const
{
    if (empty()) {
        return false;
    }
    const auto strip =
        std::min(static_cast<std::size_t>(azimuth(to_light.x, to_light.z)), strips - 1);
    const Rows blocked = skylines_[place][strip];
    const float row = static_cast<float>(rows) * 2.0f * inv_pi * acos_exact(to_light.y);
    return row >= static_cast<float>(blocked.begin) && row <= static_cast<float>(blocked.end) &&
           blocked.begin < blocked.end;
}

}  // namespace bdpt
