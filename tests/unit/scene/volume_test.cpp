#include "scene/volume.h"

#include "catch.hpp"
#include "math/sampler.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt {
namespace {

/// Of 20 x 17 x 12 voxels with a few dense ones, in a box that is turned and stretched.
VolumeDesc smoke()
{
    VolumeDesc desc;
    desc.size = {20, 17, 12};
    for (std::uint32_t z = 0; z < desc.size.z; ++z) {
        for (std::uint32_t y = 0; y < desc.size.y; ++y) {
            for (std::uint32_t x = 0; x < desc.size.x; ++x) {
                const bool empty = x < 9 && y < 9;
                const bool dense = x % 7 == 3 && z % 5 == 2;
                desc.density.push_back(empty ? 0.0f : dense ? 6.0f : 0.1f * static_cast<float>(y));
            }
        }
    }
    desc.world_from_grid = glm::scale(
        glm::rotate(glm::translate(Mat4(1.0f), Vec3(0.3f, -0.2f, 0.1f)), 0.7f, Vec3(1, 2, 3)),
        Vec3(0.1f, 0.12f, 0.2f));
    desc.extinction = 0.8f;
    return desc;
}

SegmentKey key(int i)
{
    return Sampler(SamplerKind::independent, 3, i, 0, 0).segment_key(0, 1);
}

/// The optical depth, by many steps.
double depth_of(const Volume& volume, Vec3 origin, Vec3 direction, double length)
{
    constexpr int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const auto t = static_cast<float>(length * (i + 0.5) / steps);
        sum += static_cast<double>(volume.extinction(origin + t * direction)) * length / steps;
    }
    return sum;
}

struct Ray {
    Vec3 origin;
    Vec3 direction;
    float length;
};

/// Through the volume in many ways: along its axes, from within, past it.
std::vector<Ray> rays(const VolumeDesc& desc)
{
    const auto world = [&desc](Vec3 p) { return Vec3(desc.world_from_grid * Vec4(p, 1.0f)); };
    const auto from_to = [&](Vec3 a, Vec3 b) {
        const Vec3 along = world(b) - world(a);
        const float length = glm::length(along);
        return Ray{world(a), along / length, length};
    };
    return {from_to({-3, 12.3f, 4}, {25, 12.3f, 4}), from_to({10, -5, 6}, {10, 25, 6}),
            from_to({25, 20, 15}, {-5, 3, -2}),      from_to({10.5f, 10.5f, 2.5f}, {19, 16, 11}),
            from_to({3.2f, 20, 2.4f}, {4, 8, 2.6f}), from_to({17, 3, 20}, {17.5f, 4, -5})};
}

}  // namespace

TEST_CASE("densities are those of voxels at their centres, and linear between", "[volume]")
{
    VolumeDesc desc;
    desc.size = {2, 1, 1};
    desc.density = {1.0f, 3.0f};
    desc.extinction = 2.0f;
    const Volume volume(desc);
    CHECK(volume.extinction({0.5f, 0.5f, 0.5f}) == 2.0f);
    CHECK(volume.extinction({1.5f, 0.5f, 0.5f}) == 6.0f);
    CHECK(volume.extinction({1.0f, 0.5f, 0.5f}) == Approx(4.0f));
    CHECK(volume.extinction({0.25f, 0.5f, 0.5f}) == Approx(1.5f));  // towards nothing
    CHECK(volume.extinction({0.5f, 0.5f, 0.25f}) == Approx(1.5f));
    CHECK(volume.extinction({-0.01f, 0.5f, 0.5f}) == 0.0f);
    CHECK(volume.extinction({0.5f, 1.01f, 0.5f}) == 0.0f);
}

TEST_CASE("ratio tracking lets through what the optical depth says", "[volume]")
{
    const VolumeDesc desc = smoke();
    const Volumes volumes({&desc, 1});
    int opaque = 0;
    for (const Ray& ray : rays(desc)) {
        const double expected = std::exp(
            -depth_of(volumes[0], ray.origin, ray.direction, static_cast<double>(ray.length)));
        double sum = 0.0;
        double squares = 0.0;
        constexpr int count = 40000;
        for (int i = 0; i < count; ++i) {
            const auto left = static_cast<double>(
                volumes.transmittance(ray.origin, ray.direction, ray.length, key(i)));
            REQUIRE(left >= 0.0);
            sum += left;
            squares += left * left;
        }
        const double mean = sum / count;
        const double error = std::sqrt(std::max(1e-12, squares / count - mean * mean) / count);
        CAPTURE(expected, mean, error);
        CHECK(std::abs(mean - expected) < 4.0 * error + 1e-4);
        opaque += expected < 0.5 ? 1 : 0;
    }
    CHECK(opaque >= 2);
}

TEST_CASE("delta tracking stops where the extinction is, and gets through as often", "[volume]")
{
    const VolumeDesc desc = smoke();
    const Volumes volumes({&desc, 1});
    for (const Ray& ray : rays(desc)) {
        constexpr int count = 40000;
        constexpr int bins = 10;
        double expected_before = 1.0;
        std::vector<double> counts(bins + 1);
        for (int i = 0; i < count; ++i) {
            const auto event = volumes.draw_event(ray.origin, ray.direction, ray.length, key(i));
            if (event) {
                REQUIRE(event->distance < ray.length);
                REQUIRE(event->extinction ==
                        volumes[0].extinction(ray.origin + event->distance * ray.direction));
            }
            counts[event ? static_cast<std::size_t>(event->distance / ray.length * bins) : bins] +=
                1.0 / count;
        }
        for (int i = 0; i < bins; ++i) {
            const double end = static_cast<double>(ray.length) * (i + 1) / bins;
            const double left = std::exp(-depth_of(volumes[0], ray.origin, ray.direction, end));
            const double share = std::max(0.0, expected_before - left);
            CAPTURE(i, share);
            CHECK(std::abs(counts[static_cast<std::size_t>(i)] - share) <
                  4.5 * std::sqrt(share / count) + 1e-3);
            expected_before = left;
        }
    }
}

TEST_CASE("of several volumes a walk is scattered by the first", "[volume]")
{
    VolumeDesc thin;
    thin.size = {1, 1, 1};
    thin.density = {1.0f};
    thin.extinction = 1e-3f;
    VolumeDesc dense = thin;
    dense.extinction = 1e4f;
    dense.world_from_grid = glm::translate(Mat4(1.0f), Vec3(2, 0, 0));
    const std::vector<VolumeDesc> both{thin, dense};
    const Volumes volumes(both);
    int first = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto event = volumes.draw_event({-1, 0.5f, 0.5f}, {1, 0, 0}, 100.0f, key(i));
        REQUIRE(event.has_value());
        first += event->volume == 0 ? 1 : 0;
        CHECK((event->volume == 0) == (event->distance <= 2.0f));
    }
    CHECK(first < 20);
    CHECK(volumes.transmittance({-1, 0.5f, 0.5f}, {1, 0, 0}, 100.0f, key(0)) == 0.0f);
    CHECK(volumes.transmittance({-1, 3.5f, 0.5f}, {1, 0, 0}, 100.0f, key(0)) == 1.0f);
}

TEST_CASE("rays from far away come to the end of a block that is dense in one corner", "[volume]")
{
    // Steps of a thousandth of a metre, where floats are two metres apart.
    VolumeDesc desc;
    desc.size = {8, 8, 8};
    desc.density.assign(512, 0.0f);
    desc.density[0] = 1000.0f;
    desc.world_from_grid = glm::translate(Mat4(1.0f), Vec3(2e7f, 0, 0));
    const Volumes volumes({&desc, 1});
    CHECK(volumes.transmittance({0, 6.5f, 6.5f}, {1, 0, 0}, 1e8f, key(0)) == 1.0f);
    CHECK_FALSE(volumes.draw_event({0, 6.5f, 6.5f}, {1, 0, 0}, 1e8f, key(0)));
}

}  // namespace bdpt
