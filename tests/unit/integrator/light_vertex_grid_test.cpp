#include "integrator/bidirectional/light_vertex_grid.h"

#include "catch.hpp"
#include "integrator/bidirectional/light_path_cache.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <random>
#include <vector>

namespace bdpt::light_vertex_grid_test {
namespace {

constexpr int side = 12;
const Bsdf any_bsdf{};

Vec3 random_point(std::mt19937& engine, Vec3 center, float extent)
{
    std::uniform_real_distribution<float> uniform(-extent, extent);
    return center + Vec3(uniform(engine), uniform(engine), uniform(engine));
}

RenderOptions vcm_options(int width = side)
{
    RenderOptions options;
    options.integrator = IntegratorKind::vcm;
    options.film.width = width;
    options.film.height = side;
    return options;
}

/// Light paths of up to five vertices within a cube, some of which cannot be joined.
LightPathCache random_cache(std::mt19937& engine, Vec3 center, float extent, int width = side)
{
    const RenderOptions options = vcm_options(width);
    const LightPathCounts counts(options);
    LightPathCache cache(counts, options);
    std::int64_t bundle = 0;
    for (std::int64_t chunk = 0; chunk < cache.chunks(); ++chunk) {
        cache.begin_chunk(chunk);
        for (; bundle < std::min(counts.bundles, (chunk + 1) * LightPathCache::chunk_bundles);
             ++bundle) {
            cache.add_bundle(chunk, {});
            std::vector<PathVertex> path(engine() % 6U);
            for (std::size_t i = 0; i < path.size(); ++i) {
                path[i].kind = i == 0 ? VertexKind::light : VertexKind::surface;
                path[i].end.p = random_point(engine, center, extent);
                path[i].bsdf = i == 0 ? nullptr : &any_bsdf;
                path[i].connectible = engine() % 4U != 0;
            }
            cache.add_path(chunk, path);
        }
        cache.end_chunk(chunk);
    }
    return cache;
}

}  // namespace

TEST_CASE("the grid finds each light vertex that is near, once", "[vcm]")
{
    std::mt19937 engine(7);
    // The least radius puts nearly all vertices into cubes of their own, which share buckets.
    const float extent = GENERATE(1.0f, 1e-3f, 1e6f);
    const float relative_radius = GENERATE(1e-5f, 0.02f, 0.2f, 3.0f);
    const Vec3 center = extent * Vec3(10.0f, -3.0f, 0.0f);
    const float radius = relative_radius * extent;
    CAPTURE(extent, radius);
    const LightPathCache cache = random_cache(engine, center, extent);
    LightVertexGrid grid;
    for (int pass = 0; pass < 2; ++pass) {  // a grid is built again and again
        grid.build(cache, center, radius);
    }
    std::vector<const PathVertex*> all;
    cache.for_each_path(0, cache.chunks(), [&](std::span<const PathVertex> path) {
        for (std::size_t i = 1; i < path.size(); ++i) {
            if (path[i].connectible) {
                all.push_back(&path[i]);
            }
        }
    });
    REQUIRE(all.size() > side * side);
    std::size_t found = 0;
    for (int i = 0; i < 400; ++i) {
        const Vec3 p = i % 2 == 0 ? random_point(engine, center, 1.1f * extent)
                                  : all[static_cast<std::size_t>(i) % all.size()]->end.p +
                                        random_point(engine, Vec3(0.0f), 0.7f * radius);
        std::vector<const PathVertex*> near;
        grid.for_each_near(p, [&](std::span<const PathVertex> light) {
            near.push_back(&light.back());
            REQUIRE(light[0].kind == VertexKind::light);
        });
        std::vector<const PathVertex*> expected;
        for (const PathVertex* vertex : all) {
            const Vec3 offset = vertex->end.p - p;
            if (dot(offset, offset) <= radius * radius) {
                expected.push_back(vertex);
            }
        }
        found += near.size();
        std::sort(near.begin(), near.end());
        std::sort(expected.begin(), expected.end());
        REQUIRE(near == expected);
    }
    CHECK(found > 50);
}

TEST_CASE("a grid has the same order from any number of threads", "[vcm]")
{
    std::mt19937 engine(11);
    const LightPathCache cache = random_cache(engine, Vec3(0.0f), 1.0f, 1000);
    REQUIRE(cache.chunks() > 100);
    const auto found_with = [&](int threads) {
        LightVertexGrid grid;
        const tbb::global_control allowance(tbb::global_control::max_allowed_parallelism, 8);
        tbb::task_arena arena(threads);
        arena.execute([&] { grid.build(cache, Vec3(0.0f), 0.1f); });
        std::vector<const PathVertex*> found;
        std::mt19937 places(12);
        for (int i = 0; i < 200; ++i) {
            grid.for_each_near(
                random_point(places, Vec3(0.0f), 1.0f),
                [&](std::span<const PathVertex> light) { found.push_back(&light.back()); });
        }
        return found;
    };
    const std::vector<const PathVertex*> expected = found_with(1);
    REQUIRE(expected.size() > 500);
    for (const int threads : {2, 3, 8}) {
        CHECK(found_with(threads) == expected);
    }
}

TEST_CASE("a grid without light vertices finds none", "[vcm]")
{
    const RenderOptions options = vcm_options();
    const LightPathCache cache(LightPathCounts(options), options);
    LightVertexGrid grid;
    grid.build(cache, Vec3(0.0f), 0.1f);
    grid.for_each_near(Vec3(0.0f), [](std::span<const PathVertex>) { FAIL("found one"); });
    SUCCEED();
}

}  // namespace bdpt::light_vertex_grid_test
