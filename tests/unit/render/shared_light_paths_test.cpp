// Light paths that all pixels of a sample index share: what is promised of them, but for the means,
// which are those of all integrators (tests/statistical).

#include "catch.hpp"
#include "integrator/bidirectional/light_path_cache.h"
#include "math/sampler.h"
#include "purity.h"
#include "room.h"
#include "scene_builder.h"

#include <bdpt/error.h>
#include <bdpt/render.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace bdpt::test::shared_light_paths_test {
namespace {

constexpr int width = 37;
constexpr int height = 29;

RenderOptions options(double light_paths, std::optional<double> connections = std::nullopt)
{
    RenderOptions result;
    result.integrator = IntegratorKind::bdpt;
    result.film.width = width;
    result.film.height = height;
    result.sampling.samples = {.begin = 0, .end = 6};
    result.sampling.seed = 5;
    result.transport.max_depth = 5;
    result.bidirectional.light_paths = light_paths;
    result.bidirectional.connections = connections;
    return result;
}

RenderResult image_of(const Scene& scene, const RenderOptions& options)
{
    return render(scene, room_camera(), options);
}

}  // namespace

TEST_CASE("numbers of light paths are kept for the whole image", "[light-paths]")
{
    const LightPathCounts own(options(2.0));
    CHECK_FALSE(own.shared);
    CHECK(own.per_camera_path == 2.0);
    CHECK(own.connections == 2.0);
    CHECK_FALSE(LightPathCounts(options(0.0)).shared);
    CHECK_FALSE(LightPathCounts(options(3.0, 3.0)).shared);

    const LightPathCounts few(options(0.1));
    CHECK(few.shared);
    CHECK(few.connections == 1.0);
    CHECK(few.bundle == 1);
    CHECK(few.bundles == 107);  // of 1073 pixels
    CHECK(few.per_camera_path == Approx(107.0 / 1073.0));

    const LightPathCounts bundled(options(2.0, 2.5));
    CHECK(bundled.shared);
    CHECK(bundled.bundle == 3);
    CHECK(bundled.bundles == 715);
    CHECK(bundled.per_camera_path == Approx(2145.0 / 1073.0));

    CHECK(LightPathCounts(options(1e-9)).bundles == 1);
}

TEST_CASE("the memory of shared light paths is known before they are rendered", "[light-paths]")
{
    const Scene scene = room();
    RenderOptions shared = options(0.5, 2.0);
    const std::uint64_t bytes = light_path_bytes(shared);
    CHECK(bytes > 0);
    CHECK(light_path_bytes(options(1.0, 2.0)) > bytes * 3 / 2);
    shared.bidirectional.light_path_memory = bytes;
    CHECK_NOTHROW(image_of(scene, shared));
    shared.bidirectional.light_path_memory = bytes - 1;
    CHECK_THROWS_AS(image_of(scene, shared), Error);
    CHECK(light_path_bytes(options(2.0)) == 0);  // each pixel has its own
    shared.integrator = IntegratorKind::mis;
    CHECK(light_path_bytes(shared) == 0);
}

TEST_CASE("pixels take shared light paths evenly, and neighbours take different ones",
          "[light-paths]")
{
    // The second has several groups of pixels.
    const auto [columns, rows] = GENERATE(std::tuple(64, 64), std::tuple(256, 256));
    const auto [light_paths, connections] =
        GENERATE(std::tuple(0.25, 1.0), std::tuple(0.25, 0.25), std::tuple(0.5, 2.5),
                 std::tuple(2.0, 1.0), std::tuple(0.0625, 0.5));
    CAPTURE(columns, rows, light_paths, connections);
    RenderOptions o = options(light_paths, connections);
    o.film.width = columns;
    o.film.height = rows;
    const LightPathCounts counts(o);
    const LightPathCache cache(counts, o);
    const std::uint32_t groups = cache.groups().groups();
    CHECK((groups > 1) == (columns == 256));
    const std::int64_t part = counts.bundles / groups;
    for (const std::int64_t index : {0, 1, 7}) {
        std::vector<int> joins(static_cast<std::size_t>(counts.bundles));
        int total = 0;
        int near = 0;
        for (int y = 0; y < rows; ++y) {
            for (int x = 0; x < columns; ++x) {
                const auto choice = cache.choose(x, y, {.index = index});
                REQUIRE(choice.bundle >= 0);
                REQUIRE(choice.bundle < counts.bundles);
                REQUIRE(choice.count >= static_cast<int>(connections));
                REQUIRE(choice.count <= counts.bundle);
                joins[static_cast<std::size_t>(choice.bundle)] += choice.count;
                total += choice.count;
                if (x > 0) {
                    const std::int64_t way =
                        std::abs(choice.bundle - cache.choose(x - 1, y, {.index = index}).bundle);
                    near += 8 * way < part ? 1 : 0;
                }
            }
        }
        CHECK(total == Approx(connections * columns * rows).epsilon(0.01));
        const double each = static_cast<double>(total) / static_cast<double>(counts.bundles);
        const auto [least, most] = std::minmax_element(joins.begin(), joins.end());
        CHECK(*least >= std::floor(0.74 * each));
        CHECK(*most <= std::ceil(1.26 * each));
        CHECK(near < columns * rows / 6);  // by chance a quarter would be
    }
}

TEST_CASE("the samples of a pixel take their share of connections", "[light-paths]")
{
    const double connections = GENERATE(0.25, 0.4, 1.0, 2.5);
    const RenderOptions o = options(0.25, connections);
    const LightPathCache cache(LightPathCounts(o), o);
    for (int x = 0; x < width; ++x) {
        std::array<int, 2> of_halves{};
        for (std::int64_t index = 1000; index < 1020; ++index) {
            of_halves[static_cast<std::size_t>(index % 2)] +=
                cache.choose(x, 4, {.index = index}).count;
        }
        CHECK(std::abs(of_halves[0] + of_halves[1] - 20.0 * connections) < 1.0);
        // Each half of the film is an image by itself: their difference tells the noise.
        CHECK(std::abs(of_halves[0] - 10.0 * connections) < 1.0);
        CHECK(std::abs(of_halves[1] - 10.0 * connections) < 1.0);
    }
}

TEST_CASE("a pixel is joined to each light path of its bundle equally often", "[light-paths]")
{
    // Where each sample takes all or all but one of them.
    const double connections = GENERATE(1.5, 2.5, 3.5);
    CAPTURE(connections);
    const RenderOptions o = options(0.25, connections);
    const LightPathCounts counts(o);
    const LightPathCache cache(counts, o);
    const std::int64_t samples = 4 * counts.bundle;
    for (int x = 0; x < width; ++x) {
        std::vector<int> joins(static_cast<std::size_t>(counts.bundle));
        for (std::int64_t index = 0; index < samples; ++index) {
            const auto choice = cache.choose(x, 4, {.index = index});
            for (int which = 0; which < choice.count; ++which) {
                ++joins[static_cast<std::size_t>((choice.first + which) % counts.bundle)];
            }
        }
        const auto [least, most] = std::minmax_element(joins.begin(), joins.end());
        CHECK(*least == *most);
    }
}

TEST_CASE("each shared light path has random numbers of its own", "[light-paths]")
{
    const RenderOptions o = options(0.25, 2.0);
    const LightPathCache cache(LightPathCounts(o), o);
    std::set<float> numbers;
    for (const int index : {0, 1, 2}) {
        for (const int bundle : {5, 6}) {
            for (const int which : {0, 1}) {
                numbers.insert(cache.sampler(index, bundle, which).next_1d());
            }
        }
    }
    CHECK(numbers.size() == 12);
}

TEST_CASE("the light paths that a pixel is joined to are one sequence of points", "[light-paths]")
{
    constexpr int connections = 4;
    constexpr int rounds = 8;  // of each half
    const RenderOptions o = options(0.25, connections);
    const LightPathCache cache(LightPathCounts(o), o);
    for (const int half : {0, 1}) {
        std::set<int> strata;
        for (int round = 0; round < rounds; ++round) {
            for (int which = 0; which < connections; ++which) {
                Sampler sampler = cache.sampler(2 * round + half, 5, which);
                sampler.start(SampleUse::light_start);
                strata.insert(static_cast<int>(sampler.next_1d() * rounds * connections));
            }
        }
        CHECK(strata.size() == rounds * connections);
    }
}

TEST_CASE("images with shared light paths are the same for any threads, tiles, parts and crops",
          "[light-paths][purity]")
{
    const Scene scene = room();
    const auto [light_paths, connections, rays] =
        GENERATE(std::tuple(0.25, 1.0, 0.0), std::tuple(1.0, 2.5, 0.0), std::tuple(3.0, 0.0, 0.0),
                 std::tuple(0.25, 4.0, 3.0));
    RenderOptions o = options(light_paths, connections);
    o.bidirectional.connection_rays = rays;
    o.film.filter.kind = GENERATE(FilterKind::box, FilterKind::gaussian);
    o.system.threads = 1;
    const RenderResult whole = image_of(scene, o);
    CHECK(whole.film.defects().invalid == 0);
    CHECK(whole.stats.paths.light ==
          static_cast<std::uint64_t>(LightPathCounts(o).bundles * LightPathCounts(o).bundle * 6));
    check_purity(scene, o, whole);
    RenderOptions other = o;
    other.sampling.seed = 6;
    CHECK_FALSE(image_of(scene, other).film == whole.film);
}

TEST_CASE("an image with groups of pixels is the same for any threads, tiles, parts and crops",
          "[light-paths][purity]")
{
    const Scene scene = room();
    RenderOptions o = options(0.25, 1.0);
    o.film.width = 150;
    o.film.height = 110;
    o.transport.max_depth = 2;
    const LightPathCounts counts(o);
    REQUIRE(LightPathCache(counts, o).groups().groups() == 4);
    o.system.threads = 1;
    check_purity(scene, o, image_of(scene, o));
}

TEST_CASE("tiles are rendered group by group", "[light-paths]")
{
    RenderOptions o = options(0.25, 1.0);
    o.film.width = 150;
    o.film.height = 110;
    o.transport.max_depth = 2;
    o.sampling.samples = {.begin = 0, .end = 1};
    o.system.threads = 1;
    const LightPathCache cache(LightPathCounts(o), o);
    std::vector<std::int64_t> parts;
    RenderControl control;
    control.on_path = [&](const PathContribution& path) {
        if (path.strategy.t >= 2) {
            parts.push_back(
                cache.part(static_cast<int>(path.raster.x), static_cast<int>(path.raster.y)));
        }
    };
    static_cast<void>(render(room(), room_camera(), o, control));
    REQUIRE(parts.size() > 1000);
    CHECK(std::ranges::is_sorted(parts));
    CHECK(parts.back() == 3);
}

TEST_CASE("a batch has the light paths of its pixels, in the memory of earlier ones",
          "[light-paths]")
{
    RenderOptions o = options(1.0, 0.5);
    o.film.width = 256;
    o.film.height = 256;
    LightPathCounts counts(o);
    REQUIRE(counts.batches == 1);
    counts.bundles -= GENERATE(0, 1, 77);
    counts.batches = GENERATE(1, 2, 8);
    CAPTURE(counts.bundles, counts.batches);
    LightPathCache cache(counts, o);
    std::int64_t filled = 0;
    for (std::int64_t batch = 0; batch < counts.batches; ++batch) {
        const ChunkRange chunks = cache.begin_batch(batch);
        CHECK(chunks.begin == filled);
        filled = chunks.end;
        for (std::int64_t chunk = chunks.begin; chunk < chunks.end; ++chunk) {
            cache.begin_chunk(chunk);
            const std::int64_t first = chunk * LightPathCache::chunk_bundles;
            for (std::int64_t bundle = first;
                 bundle < std::min(first + LightPathCache::chunk_bundles, counts.bundles);
                 ++bundle) {
                cache.add_bundle(chunk, {});
                PathVertex vertex;
                vertex.end.p.x = static_cast<float>(bundle);
                cache.add_path(chunk, std::span(&vertex, 1));
            }
            cache.end_chunk(chunk);
        }
        int wrong = 0;
        int pixels = 0;
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) {
                if (cache.batch(x, y) == batch) {
                    const auto choice = cache.choose(x, y, {.index = 3, .sub_index = 0x9e3779b9U});
                    const auto path = cache.path(choice, 0);
                    ++pixels;
                    wrong += path.front().end.p.x == static_cast<float>(choice.bundle) ? 0 : 1;
                }
            }
        }
        CHECK(pixels == 256 * 256 / counts.batches);
        CHECK(wrong == 0);
    }
    CHECK(filled == cache.chunks());
}

TEST_CASE("a large image has batches of light paths, with tiles of any size", "[light-paths]")
{
    const Scene scene = room();
    RenderOptions o = options(0.25, 1.0);
    o.film.width = 1024;
    o.film.height = 512;
    o.transport.max_depth = 2;
    o.sampling.samples = {.begin = 0, .end = 1};
    const LightPathCounts counts(o);
    REQUIRE(counts.batches == 2);
    const RenderResult image = image_of(scene, o);
    CHECK(image.stats.paths.light == static_cast<std::uint64_t>(counts.bundles * counts.bundle));
    o.system.tile_size = 24;
    o.film.crop = PixelRect{.x0 = 301, .y0 = 203, .x1 = 717, .y1 = 319};
    RenderResult crop = image_of(scene, o);
    int different = 0;
    const Image whole_pixels = image.film.develop();
    const Image crop_pixels = crop.film.develop();
    for (int y = 203; y < 319; ++y) {
        for (int x = 301; x < 717; ++x) {
            const auto of_whole = static_cast<std::size_t>(y * 1024 + x);
            const auto of_crop = static_cast<std::size_t>((y - 203) * 416 + x - 301);
            different += whole_pixels.pixels[of_whole] == crop_pixels.pixels[of_crop] ? 0 : 1;
        }
    }
    CHECK(different == 0);

    // Twice the pixels need no more memory.
    RenderOptions larger = o;
    larger.film.crop.reset();
    larger.film.width = 2048;
    CHECK(LightPathCounts(larger).batches == 4);
    CHECK(light_path_bytes(larger) == light_path_bytes(o));
    larger.integrator = IntegratorKind::vcm;  // merges with all light paths
    CHECK(light_path_bytes(larger) > 4 * light_path_bytes(o));
}

TEST_CASE("chosen connections cost as many shadow rays as asked for", "[light-paths]")
{
    const Scene scene = room();
    RenderOptions o = options(0.5, 8.0);
    const RenderStats all = image_of(scene, o).stats;
    o.bidirectional.connection_rays = 2.0;
    const RenderStats chosen = image_of(scene, o).stats;
    CHECK(chosen.paths == all.paths);
    CHECK(chosen.rays.light == all.rays.light);
    const double rays =
        static_cast<double>(chosen.rays.shadow_interior) / static_cast<double>(chosen.paths.camera);
    CHECK(rays < 2.0);  // BSDFs may be black, and one connection may be chosen twice
    CHECK(rays > 1.0);
    CHECK(all.rays.shadow_interior > 5 * chosen.rays.shadow_interior);
}

TEST_CASE("observers learn how often a connection is chosen", "[light-paths]")
{
    RenderOptions o = options(0.5, 8.0);
    o.bidirectional.connection_rays = 2.0;
    o.system.threads = 1;
    int connections = 0;
    int rarely_chosen = 0;
    bool others_are_sure = true;
    RenderControl control;
    control.on_path = [&](const PathContribution& path) {
        if (path.strategy.s >= 2 && path.strategy.t >= 2) {
            CHECK(path.chance > 0.0f);
            ++connections;
            rarely_chosen += path.chance < 0.5f ? 1 : 0;
        } else {
            others_are_sure = others_are_sure && path.chance == 1.0f;
        }
    };
    static_cast<void>(render(room(), room_camera(), o, control));
    CHECK(others_are_sure);
    CHECK(connections > 100);
    CHECK(rarely_chosen > 10);
}

TEST_CASE("own light paths are shared where connections are chosen", "[light-paths]")
{
    RenderOptions o = options(2.0, 2.0);
    CHECK_FALSE(LightPathCounts(o).shared);
    o.bidirectional.connection_rays = 1.0;
    CHECK(LightPathCounts(o).shared);
    CHECK(LightPathCounts(o).bundle == 2);
}

TEST_CASE("without light paths bdpt is path tracing with next-event estimation", "[light-paths]")
{
    const RenderResult result = image_of(room(), options(0.0));
    CHECK(result.stats.paths.light == 0);
    CHECK(result.stats.rays.light == 0);
    CHECK(result.film.develop().at(18, 14).g > 0.0f);
}

TEST_CASE("scenes without light leave shared light paths empty", "[light-paths]")
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), lambertian(Rgb(0.5f)));
    const RenderResult result = image_of(Scene(std::move(builder.desc)), options(0.5, 1.5));
    CHECK(result.film.develop().at(18, 14) == Rgb(0.0f));
    CHECK(result.film.defects().invalid == 0);
}

}  // namespace bdpt::test::shared_light_paths_test
