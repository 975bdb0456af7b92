#include "path/segment_sample.h"

#include "catch.hpp"
#include "scene_builder.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace bdpt::segment_sample_test {
namespace {

constexpr SegmentEnd lens{.p = {0.1f, 0.2f, 20.0f}};
constexpr Vec3 down(0.0f, 0.0f, -1.0f);

/// Panes below each other, the first one highest, at z = 0, -1, ...
World panes(int count, float alpha)
{
    test::SceneBuilder builder;
    MaterialDesc pane = test::lambertian(Rgb(0.5f));
    pane.alpha_mode = AlphaMode::blend;
    pane.base_color.w = alpha;
    for (int i = 0; i < count; ++i) {
        const float z = -static_cast<float>(i);
        builder.quad({-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}, pane);
    }
    return World(std::move(builder.desc));
}

/// Returns the number of the pane that the ray of a sample hits; -1 if it passes all.
int pane_hit(const World& world, int pixel, int sample)
{
    Sampler sampler(SamplerKind::sobol, 5, pixel, 0, sample);
    const SegmentKey segment = sampler.segment_key(0, 1);
    bool is_tinted = false;
    const auto hit = first_camera_hit(world, sampler, lens, down, segment, is_tinted);
    CHECK_FALSE(is_tinted);
    return hit ? static_cast<int>(std::lround(-hit->at.point.p.z)) : -1;
}

}  // namespace

TEST_CASE("what a pixel's rays hit of a pane that they may pass is stratified", "[alpha]")
{
    constexpr float alpha = 0.3f;
    constexpr int samples = 128;
    const World world = panes(1, alpha);
    for (int pixel = 0; pixel < 50; ++pixel) {
        int hits = 0;
        for (int i = 0; i < samples; ++i) {
            hits += pane_hit(world, pixel, i) == 0 ? 1 : 0;
        }
        // Both halves of the samples have sequences of their own. Chance would deviate by 5.
        CHECK(std::abs(static_cast<float>(hits) - alpha * samples) <= 2.0f);
    }
}

TEST_CASE("camera rays pass each of several panes independently", "[alpha]")
{
    // With more panes than a ray can record, the keys of the segments decide.
    const int count = GENERATE(3, 40);
    constexpr double alpha = 0.25;
    constexpr int pixels = 2000;
    constexpr int samples = 8;
    const World world = panes(count, static_cast<float>(alpha));
    std::array<int, 3> hits{};
    for (int pixel = 0; pixel < pixels; ++pixel) {
        for (int i = 0; i < samples; ++i) {
            const int pane = pane_hit(world, pixel, i);
            if (pane >= 0 && pane < 3) {
                ++hits.at(static_cast<std::size_t>(pane));
            }
        }
    }
    double arriving = 1.0;
    for (const int hit : hits) {
        const double expected = pixels * samples * arriving * alpha;
        CHECK(std::abs(hit - expected) < 5.0 * std::sqrt(expected));
        arriving *= 1.0 - alpha;
    }
}

TEST_CASE("camera rays that pass a tinted sheet tell so", "[alpha]")
{
    test::SceneBuilder builder;
    MaterialDesc sheet = test::thin_glass(0.0f);
    sheet.base_color = {0.5f, 1.0f, 1.0f, 1.0f};
    builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, sheet);
    const World world(std::move(builder.desc));
    int passed = 0;
    for (int i = 0; i < 64; ++i) {
        Sampler sampler(SamplerKind::sobol, 5, 0, 0, i);
        const SegmentKey segment = sampler.segment_key(0, 1);
        bool is_tinted = false;
        const auto hit = first_camera_hit(world, sampler, lens, down, segment, is_tinted);
        CHECK(is_tinted == !hit.has_value());
        passed += hit ? 0 : 1;
    }
    CHECK(passed >= 60);  // 0.96 of 64
    CHECK(passed <= 63);
}

}  // namespace bdpt::segment_sample_test
