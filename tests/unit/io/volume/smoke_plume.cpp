#include "smoke_plume.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace bdpt::test {
namespace {

// No function of the C library, so that all machines have the same bits.

/// In [0, 1), by hashing a point of a lattice.
double hashed(std::int64_t x, std::int64_t y, std::int64_t z)
{
    auto h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15U ^
             static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fU ^
             static_cast<std::uint64_t>(z) * 0x165667b19e3779f9U;
    for (int i = 0; i < 2; ++i) {
        h ^= h >> 29U;
        h *= 0xbf58476d1ce4e5b9U;
        h ^= h >> 32U;
    }
    return static_cast<double>(h >> 11U) * 0x1p-53;
}

double smooth(double t)
{
    return t * t * (3.0 - 2.0 * t);
}

struct Point {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

/// Value noise in [-1, 1], with features of size 1.
double noise(Point p)
{
    std::array<std::int64_t, 3> cell{};
    std::array<double, 3> t{};
    const std::array<double, 3> at{p.x + 4096.0, p.y + 4096.0, p.z + 4096.0};  // positive
    for (std::size_t axis = 0; axis < 3; ++axis) {
        cell[axis] = static_cast<std::int64_t>(at[axis]);
        t[axis] = smooth(at[axis] - static_cast<double>(cell[axis]));
    }
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        std::array<std::int64_t, 3> at_corner{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool upper = ((corner >> axis) & 1) != 0;
            weight *= upper ? t[axis] : 1.0 - t[axis];
            at_corner[axis] = cell[axis] + (upper ? 1 : 0);
        }
        sum += weight * hashed(at_corner[0], at_corner[1], at_corner[2]);
    }
    return 2.0 * sum - 1.0;
}

/// Noise of several sizes, each half of the last.
double turbulence(Point p, int sizes)
{
    double sum = 0.0;
    double scale = 1.0;
    for (int i = 0; i < sizes; ++i) {
        sum += noise({p.x * scale, p.y * scale, p.z * scale + 17.0 * i}) / scale;
        scale *= 2.0;
    }
    return sum;
}

constexpr double height = 1.2;  // [m]

/// Where smoke at `p` would be in a calm column: the higher, the more it winds and whirls.
Point calmed(Point p)
{
    const double up = p.y / height;
    const double winding = 0.15 * up;
    const Point lean{p.x - winding * noise({3.5, 2.2 * p.y, 0.5}), p.y,
                     p.z - winding * noise({9.5, 2.2 * p.y, 7.5})};
    const double whirl = 0.1 * up + 0.012;
    const auto moved = [&](double offset) {
        return whirl * turbulence({4.0 * lean.x, 4.0 * lean.y + offset, 4.0 * lean.z}, 3);
    };
    return {lean.x + moved(0.0), lean.y + moved(90.0), lean.z + moved(50.0)};
}

/// At a point in metres, y up.
double density(Point p)
{
    const double up = p.y / height;
    if (up <= 0.0 || up >= 1.0) {
        return 0.0;
    }
    const Point q = calmed(p);
    const double radius = 0.035 + 0.13 * up;
    const double away = (q.x * q.x + q.z * q.z) / (radius * radius);
    const double ragged = 0.9 * turbulence({6.0 * q.x, 5.0 * q.y, 6.0 * q.z}, 4);
    const double body = smooth(std::clamp((1.15 - away + ragged) / 1.6, 0.0, 1.0));
    const double fading =
        smooth(std::min(2.2 * (1.0 - up), 1.0)) * smooth(std::min(20.0 * up, 1.0));
    return body * fading * 0.042 / radius;
}

}  // namespace

openvdb::FloatGrid::Ptr smoke_plume()
{
    constexpr double voxel = 0.0125;  // [m]
    auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setName("density");
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
    transform->postTranslate(openvdb::Vec3d(-0.6, 1.11, 1.6));
    grid->setTransform(transform);
    grid->setSaveFloatAsHalf(true);
    for (auto i = openvdb::CoordBBox({-35, 0, -35}, {35, 96, 35}).begin(); i; ++i) {
        const double value = density({(*i).x() * voxel, (*i).y() * voxel, (*i).z() * voxel});
        // Steps of 1/256 are exact in half precision, and can be compressed.
        const double step = static_cast<double>(static_cast<int>(value * 256.0 + 0.5)) / 256.0;
        if (step > 0.0) {
            grid->tree().setValue(*i, static_cast<float>(step));
        }
    }
    return grid;
}

}  // namespace bdpt::test
