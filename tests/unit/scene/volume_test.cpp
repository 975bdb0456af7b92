#include "scene/volume.h"

#include "catch.hpp"
#include "math/sampler.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt::volume_test {
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
    desc.extinction = {0.8f, 0.5f, 1.2f};
    return desc;
}

SegmentKey key(int i)
{
    return Sampler(SamplerKind::independent, 3, i, 0, 0).segment_key(0, 1);
}

/// The transmittance, by many steps.
glm::dvec3 left_of(const Volume& volume, Vec3 origin, Vec3 direction, double length)
{
    constexpr int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const auto t = static_cast<float>(length * (i + 0.5) / steps);
        sum += static_cast<double>(volume.density(origin + t * direction)) * length / steps;
    }
    return exp(-sum * glm::dvec3(volume.extinction(1.0f)));
}

/// The mean of many estimates, and its standard error, for each channel.
class Mean {
public:
    void add(glm::dvec3 x)
    {
        sum_ += x;
        squares_ += x * x;
        ++count_;
    }
    void check(glm::dvec3 expected) const
    {
        const glm::dvec3 mean = sum_ / count_;
        for (int c = 0; c < 3; ++c) {
            const double variance = squares_[c] / count_ - mean[c] * mean[c];
            const double error = std::sqrt(std::max(1e-12, variance) / count_);
            CAPTURE(c, expected[c], mean[c], error);
            CHECK(std::abs(mean[c] - expected[c]) < 4.5 * error + 1e-4);
        }
    }

private:
    glm::dvec3 sum_{0.0};
    glm::dvec3 squares_{0.0};
    double count_ = 0.0;
};

struct TestRay {
    Vec3 origin;
    Vec3 direction;
    float length;
};

/// Through the volume in many ways: along its axes, from within, past it.
std::vector<TestRay> rays(const VolumeDesc& desc)
{
    const auto world = [&desc](Vec3 p) { return Vec3(desc.world_from_grid * Vec4(p, 1.0f)); };
    const auto from_to = [&](Vec3 a, Vec3 b) {
        const Vec3 along = world(b) - world(a);
        const float length = glm::length(along);
        return TestRay{world(a), along / length, length};
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
    desc.extinction = {2.0f, 1.0f, 0.0f};
    const Volume volume(desc);
    CHECK(volume.density({0.5f, 0.5f, 0.5f}) == 1.0f);
    CHECK(volume.density({1.5f, 0.5f, 0.5f}) == 3.0f);
    CHECK(volume.density({1.0f, 0.5f, 0.5f}) == Approx(2.0f));
    CHECK(volume.density({0.25f, 0.5f, 0.5f}) == Approx(0.75f));  // towards nothing
    CHECK(volume.density({0.5f, 0.5f, 0.25f}) == Approx(0.75f));
    CHECK(volume.density({-0.01f, 0.5f, 0.5f}) == 0.0f);
    CHECK(volume.density({0.5f, 1.01f, 0.5f}) == 0.0f);
    CHECK(volume.extinction(3.0f) == Rgb(6.0f, 3.0f, 0.0f));
}

TEST_CASE("ratio tracking lets through what the optical depth says", "[volume]")
{
    const VolumeDesc desc = smoke();
    const Volumes volumes({&desc, 1});
    int opaque = 0;
    for (const TestRay& ray : rays(desc)) {
        const glm::dvec3 expected =
            left_of(volumes[0], ray.origin, ray.direction, static_cast<double>(ray.length));
        Mean mean;
        for (int i = 0; i < 40000; ++i) {
            const Rgb left = volumes.transmittance(ray.origin, ray.direction, ray.length, key(i));
            REQUIRE(left.r >= 0.0f);
            mean.add(glm::dvec3(left));
        }
        mean.check(expected);
        opaque += expected.r < 0.5 ? 1 : 0;
    }
    CHECK(opaque >= 2);
}

TEST_CASE("delta tracking stops where the extinction is, and gets through as often",
          "[volume][long]")
{
    // Grey and coloured: what walks bring is what light loses, in all channels.
    VolumeDesc grey = smoke();
    grey.extinction = Rgb(0.8f);
    VolumeDesc red = smoke();
    red.extinction = {0.9f, 0.0f, 0.3f};
    const Rgb beta = GENERATE(Rgb(1.0f), Rgb(0.2f, 1.0f, 0.5f), Rgb(1.0f, 0.0f, 3.0f));
    const ChannelChoice channels(beta);
    const float sum_of_beta = beta.r + beta.g + beta.b;
    for (const VolumeDesc& desc : {grey, smoke(), red}) {
        const Volumes volumes({&desc, 1});
        for (const TestRay& ray : rays(desc)) {
            constexpr std::size_t bins = 10;
            std::vector<Mean> found(bins + 1);
            for (int i = 0; i < 40000; ++i) {
                const VolumePassage walk =
                    volumes.walk(ray.origin, ray.direction, ray.length, channels, key(i));
                std::size_t bin = bins;
                glm::dvec3 value(walk.weight);
                if (walk.event) {
                    REQUIRE(walk.event->distance < ray.length);
                    const float density = walk.event->density;
                    REQUIRE(density ==
                            volumes[0].density(ray.origin + walk.event->distance * ray.direction));
                    bin = static_cast<std::size_t>(walk.event->distance / ray.length * bins);
                    value *= glm::dvec3(volumes[0].extinction(density));
                }
                // Distances do not change the sum of the throughput.
                const glm::dvec3 after = glm::dvec3(beta) * value;
                REQUIRE(after.r + after.g + after.b == Approx(sum_of_beta).epsilon(1e-4));
                value = after;
                for (std::size_t b = 0; b <= bins; ++b) {
                    found[b].add(b == bin ? value : glm::dvec3(0.0));
                }
            }
            glm::dvec3 before(1.0);
            for (std::size_t b = 0; b < bins; ++b) {
                const double end =
                    static_cast<double>(ray.length) * static_cast<double>(b + 1) / bins;
                const glm::dvec3 left = left_of(volumes[0], ray.origin, ray.direction, end);
                CAPTURE(b, ray.length);
                found[b].check(glm::dvec3(beta) * (before - left));
                before = left;
            }
            found[bins].check(glm::dvec3(beta) * before);
        }
    }
}

TEST_CASE("walks through volumes of other colours bring what both let through", "[volume]")
{
    VolumeDesc red = smoke();
    red.extinction = {0.6f, 0.1f, 0.2f};
    VolumeDesc blue = smoke();
    blue.extinction = {0.1f, 0.3f, 0.7f};
    blue.world_from_grid = glm::translate(blue.world_from_grid, Vec3(3, -2, 1));
    const std::vector<VolumeDesc> both{red, blue};
    const Volumes volumes(both);
    const ChannelChoice channels(GENERATE(Rgb(1.0f), Rgb(0.3f, 1.0f, 0.5f)));
    for (const TestRay& ray : rays(red)) {
        const auto length = static_cast<double>(ray.length);
        const glm::dvec3 left = left_of(volumes[0], ray.origin, ray.direction, length) *
                                left_of(volumes[1], ray.origin, ray.direction, length);
        Mean through;
        Mean scattered;
        for (int i = 0; i < 40000; ++i) {
            const VolumePassage walk =
                volumes.walk(ray.origin, ray.direction, ray.length, channels, key(i));
            const glm::dvec3 weight(walk.weight);
            through.add(walk.event ? glm::dvec3(0.0) : weight);
            scattered.add(walk.event ? weight * glm::dvec3(volumes[walk.event->volume].extinction(
                                                    walk.event->density))
                                     : glm::dvec3(0.0));
        }
        through.check(left);
        scattered.check(1.0 - left);
    }
}

TEST_CASE("a walk that passes a point in a coloured volume brings the light of that point",
          "[volume]")
{
    const VolumeDesc desc = smoke();
    const Volumes volumes({&desc, 1});
    const ChannelChoice channels(GENERATE(Rgb(1.0f), Rgb(0.3f, 1.0f, 0.5f)));
    for (const TestRay& ray : rays(desc)) {
        const float half = 0.5f * ray.length;
        const glm::dvec3 left =
            left_of(volumes[0], ray.origin, ray.direction, static_cast<double>(half));
        Mean passing;
        for (int i = 0; i < 40000; ++i) {
            const auto event =
                volumes.walk(ray.origin, ray.direction, ray.length, channels, key(i)).event;
            const bool passes = !event || event->distance > half;
            passing.add(passes ? glm::dvec3(volumes.weight_of_passing(ray.origin, ray.direction,
                                                                      half, channels, key(i)))
                               : glm::dvec3(0.0));
        }
        passing.check(left);
    }
}

TEST_CASE("of several volumes a walk is scattered by the first", "[volume]")
{
    VolumeDesc thin;
    thin.size = {1, 1, 1};
    thin.density = {1.0f};
    thin.extinction = Rgb(1e-3f);
    VolumeDesc dense = thin;
    dense.extinction = Rgb(1e4f);
    dense.world_from_grid = glm::translate(Mat4(1.0f), Vec3(2, 0, 0));
    const std::vector<VolumeDesc> both{thin, dense};
    const Volumes volumes(both);
    const ChannelChoice white(Rgb(1.0f));
    int first = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto event = volumes.walk({-1, 0.5f, 0.5f}, {1, 0, 0}, 100.0f, white, key(i)).event;
        REQUIRE(event.has_value());
        first += event->volume == 0 ? 1 : 0;
        CHECK((event->volume == 0) == (event->distance <= 2.0f));
    }
    CHECK(first < 20);
    CHECK(volumes.transmittance({-1, 0.5f, 0.5f}, {1, 0, 0}, 100.0f, key(0)) == Rgb(0.0f));
    CHECK(volumes.transmittance({-1, 3.5f, 0.5f}, {1, 0, 0}, 100.0f, key(0)) == Rgb(1.0f));
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
    CHECK(volumes.transmittance({0, 6.5f, 6.5f}, {1, 0, 0}, 1e8f, key(0)) == Rgb(1.0f));
    CHECK_FALSE(
        volumes.walk({0, 6.5f, 6.5f}, {1, 0, 0}, 1e8f, ChannelChoice(Rgb(1.0f)), key(0)).event);
}

}  // namespace bdpt::volume_test
