#include "call_counter.h"
#include "camera/camera.h"
#include "catch.hpp"
#include "integrator/integrator.h"
#include "moving_scenes.h"
#include "render/aov_pass.h"
#include "scene/world.h"
#include "scene_builder.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace bdpt::hot_path_test {
namespace {

using test::RuntimeCalls;
using test::SceneBuilder;

constexpr int size = 16;  // of the image [pixels]

/// Image 0: colours, half of them see-through; 1: slopes, for a normal map.
void add_images(SceneDesc& desc)
{
    TexelImage colors{.width = 4, .height = 4, .bytes = {}};
    TexelImage slopes{.width = 4, .height = 4, .bytes = {}};
    for (int i = 0; i < 16; ++i) {
        const auto level = static_cast<std::uint8_t>(16 * i);
        colors.bytes.insert(colors.bytes.end(),
                            {level, 200, 90, i % 2 == 0 ? level : std::uint8_t{255}});
        slopes.bytes.insert(slopes.bytes.end(), {level, 128, 220, 255});
    }
    desc.images = {std::move(colors), std::move(slopes)};
}

/// Each kind of material, light and geometry that there is, within a room with an open front.
SceneDesc everything()
{
    SceneBuilder builder;
    add_images(builder.desc);
    const TextureRef colors{.image = ImageId{0}};
    const TextureRef slopes{.image = ImageId{1}};
    MaterialDesc bumpy = test::plastic(Rgb(0.6f), 0.3f);
    bumpy.base_color_texture = colors;
    bumpy.metallic_roughness_texture = colors;
    bumpy.normal_texture = slopes;
    builder.walls(bumpy, test::lambertian(Rgb(0.7f)));
    MaterialDesc screen = test::emitter(Rgb(3.0f));
    screen.emission_texture = colors;
    builder.quad({-0.6f, 0.1f, -0.99f}, {0.6f, 0.1f, -0.99f}, {0.6f, 0.8f, -0.99f},
                 {-0.6f, 0.8f, -0.99f}, screen);
    builder.lamp(0.95f, 0.2f, Rgb(6.0f));
    MaterialDesc unlit = test::lambertian(Rgb(0.4f));
    unlit.unlit = true;
    builder.quad({-0.9f, -0.9f, -0.9f}, {-0.5f, -0.9f, -0.9f}, {-0.5f, -0.5f, -0.9f},
                 {-0.9f, -0.5f, -0.9f}, unlit);

    MaterialDesc mask = test::lambertian(Rgb(0.8f));
    mask.base_color_texture = colors;
    mask.alpha_mode = AlphaMode::mask;
    MaterialDesc blend = test::plastic(Rgb(0.8f), 0.2f);
    blend.base_color = Vec4(0.8f, 0.3f, 0.3f, 0.4f);
    blend.alpha_mode = AlphaMode::blend;
    builder.sphere({-0.6f, -0.1f, 0.0f}, 0.3f, mask, 12);
    builder.sphere({-0.1f, 0.0f, 0.3f}, 0.4f, blend, 12);

    MaterialDesc layers = test::plastic(Rgb(0.5f), 0.3f);
    layers.coat.factor = 1.0f;
    layers.coat.color_texture = colors;
    layers.coat.anisotropy_strength = 0.5f;
    layers.coat.normal_texture = slopes;
    layers.fuzz.factor = 0.5f;
    layers.fuzz.color_texture = colors;
    layers.anisotropy.strength = 0.5f;
    layers.anisotropy.texture = colors;
    layers.iridescence.factor = 0.5f;
    layers.iridescence.texture = colors;
    layers.diffuse_transmission.factor = 0.5f;
    layers.diffuse_transmission.texture = colors;
    layers.glossiness_texture = colors;
    builder.sphere({0.5f, 0.0f, 0.0f}, 0.3f, layers, 12);
    test::deform(builder.desc.meshes.back(), 3,
                 [](Vec3 p, float t) { return p * (1.0f + 0.2f * t); });

    MaterialDesc absorbing = test::glass(0.0f);
    absorbing.dispersion = 1.0f;
    absorbing.attenuation_distance = 0.2f;
    absorbing.attenuation_color = {0.9f, 0.5f, 0.4f};
    absorbing.volume_scatter = {.color = Rgb(0.8f), .anisotropy = 0.5f};
    builder.desc.fog = MediumDesc{.extinction = {0.2f, 0.3f, 0.4f}, .albedo = Rgb(0.8f)};
    const MeshId ball = builder.sphere_mesh(12);  // shared: instances
    float x = -0.75f;
    for (const MaterialDesc& material :
         {absorbing, test::glass(0.4f), test::thin_glass(0.0f), test::thin_glass(0.3f),
          test::metal({0.9f, 0.7f, 0.3f}, 0.0f), test::metal(Rgb(0.8f), 0.3f)}) {
        builder.place(ball, material,
                      glm::scale(glm::translate(Mat4(1.0f), Vec3(x, -0.8f, 0.4f)), Vec3(0.14f)));
        x += 0.3f;
    }
    test::move_last(builder, 2, [](float t) {
        return glm::scale(test::translation({0.75f, 0.3f * t - 0.8f, 0.4f}), Vec3(0.14f));
    });

    builder.light(PointLightDesc{.position = {0.5f, 0.5f, 0.5f}, .intensity = Rgb(0.5f)});
    builder.light(
        PointLightDesc{.position = {0.6f, 0.3f, 0.2f}, .intensity = Rgb(0.4f), .radius = 0.1f});
    builder.light(SpotLightDesc{.position = {-0.5f, 0.8f, 0.6f},
                                .direction = {0.3f, -1.0f, -0.4f},
                                .intensity = Rgb(2.0f),
                                .motion = {{-0.3f, 0.8f, 0.6f}},
                                .later_directions = {{0.0f, -1.0f, 0.0f}}});
    builder.light(
        DirectionalLightDesc{.direction = {0.2f, -0.3f, -1.0f}, .illuminance = Rgb(1.0f)});
    builder.desc.profiles.push_back({.polar_angles = {0.0f, 0.5f, 1.5f},
                                     .azimuths = {0.0f, 2.0f, 6.2831853f},
                                     .intensities = {1, 2, 0, 1, 0, 1, 1, 2, 0}});
    builder.light(ProfileLightDesc{.position = {-0.4f, 0.2f, 0.7f}, .scale = Rgb(0.5f)});
    Image sky{.width = 4, .height = 2, .pixels = std::vector<Rgb>(8, Rgb(0.3f))};
    sky.pixels[2] = Rgb(2.0f);
    builder.light(EnvironmentLightDesc{.radiance = std::move(sky)});
    return std::move(builder.desc);
}

std::array<CameraDesc, 3> cameras()
{
    std::array<CameraDesc, 3> result{test::room_camera(), test::room_camera(), test::room_camera()};
    result[1].lens_radius = 0.3f;
    result[1].focus_distance = 3.0f;
    result[1] = test::moving(result[1]);
    result[2].projection = Projection::orthographic;
    return result;
}

RenderOptions options_of(IntegratorKind integrator)
{
    RenderOptions options;
    options.integrator = integrator;
    options.film.width = size;
    options.film.height = size;
    options.film.clamp = 100.0f;
    return options;
}

constexpr Tile whole{.x_begin = 0, .x_end = size, .y_begin = 0, .y_end = size};
constexpr PixelRect region{.x0 = 0, .y0 = 0, .x1 = size, .y1 = size};

/// What `work` asks the runtime for.
RuntimeCalls calls_of(const std::function<void()>& work)
{
    const RuntimeCalls before = test::runtime_calls();
    work();
    return test::runtime_calls() - before;
}

/// `render(samples)` may set something up for a tile, but nothing for a sample.
void check_costs_nothing_a_sample(const std::function<void(std::int64_t)>& render)
{
    render(64);  // what is done once and for all is done now
    const RuntimeCalls one = calls_of([&] { render(1); });
    const RuntimeCalls many = calls_of([&] { render(64); });
    CAPTURE(one.allocations, many.allocations);
    CHECK(many.allocations == one.allocations);
    CHECK(many.locks == 0);
    CHECK(many.throws == 0);
}

void check(const World& world, const CameraDesc& desc, const RenderOptions& options)
{
    const MovingCamera camera(desc, Camera(desc, size, size));
    const auto integrator = make_integrator(world, camera, options);
    Film film(FilmLayout{.width = size,
                         .height = size,
                         .region = region,
                         .splats = SplatImage::present,
                         .clamp = options.film.clamp});
    StrategyFilm strategies;
    const std::function<void(const PathContribution&)> nobody;
    const Films films{.film = &film, .strategies = strategies, .on_path = nobody};
    std::uint64_t rays = 0;
    // What tiles share; here the samples of all indices do.
    const ChunkRange chunks = integrator->begin_batch({.begin = 0, .end = 1}, 0);
    for (std::int64_t chunk = chunks.begin; chunk < chunks.end; ++chunk) {
        static_cast<void>(integrator->render_chunk(chunk, {.begin = 0, .end = 1}, films));
    }
    integrator->end_chunks();
    check_costs_nothing_a_sample([&](std::int64_t samples) {
        rays = integrator->render_tile(whole, {.begin = 0, .end = samples}, films).rays.total();
    });
    CHECK(rays > 64 * size * size / 2);
}

}  // namespace

TEST_CASE("hot path: allocations, locks and exceptions are counted", "[hot_path]")
{
    // Through pointers, or the compiler may leave out what has no effect.
    std::function<void()> allocate = [] {
        std::vector<int>* volatile made = new std::vector<int>(100);
        delete made;
    };
    CHECK(calls_of(allocate).allocations == 2);
    std::mutex mutex;
    std::function<void()> lock = [&mutex] { const std::lock_guard guard(mutex); };
    lock();
    CHECK(calls_of(lock) == RuntimeCalls{.allocations = 0, .locks = 1, .throws = 0});
    std::function<void()> fail = [] {
        try {
            throw 1;
        } catch (int) {
        }
    };
    CHECK(calls_of(fail).throws == 1);
    CHECK(calls_of([] {}) == RuntimeCalls{});
}

TEST_CASE("hot path: a sample allocates nothing, takes no lock and throws nothing", "[hot_path]")
{
    const World world(everything());
    for (const CameraDesc& camera : cameras()) {
        for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::lt, IntegratorKind::vcm,
                                IntegratorKind::mis, IntegratorKind::nee, IntegratorKind::pt}) {
            CAPTURE(static_cast<int>(kind));
            check(world, camera, options_of(kind));
        }
    }
}

TEST_CASE("hot path: nor do the options change that", "[hot_path][long]")
{
    const World world(everything());
    const CameraDesc camera = cameras()[1];
    for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::mis}) {
        for (const auto heuristic :
             {Heuristic::balance, Heuristic::cutoff, Heuristic::maximum, Heuristic::uniform}) {
            CAPTURE(static_cast<int>(kind), static_cast<int>(heuristic));
            RenderOptions options = options_of(kind);
            options.transport.heuristic = heuristic;
            check(world, camera, options);
        }
        RenderOptions options = options_of(kind);
        options.sampling.sampler = SamplerKind::independent;
        options.film.filter.kind = FilterKind::gaussian;
        options.transport.rr_start = 2;
        options.bidirectional.light_paths = 2;
        options.bidirectional.disabled = {{.s = 2, .t = 1}};
        options.film.clamp = 0.5f;
        check(world, camera, options);
    }
    RenderOptions merging = options_of(IntegratorKind::vcm);
    merging.bidirectional.merge_radius = 0.1;
    merging.bidirectional.disabled = {{.s = 2, .t = 1}};
    check(world, camera, merging);
}

TEST_CASE("hot path: nor do AOVs", "[hot_path]")
{
    const World world(everything());
    RenderOptions options = options_of(IntegratorKind::bdpt);
    options.film.aovs = {Aov::albedo,   Aov::normal,        Aov::depth,    Aov::position,
                         Aov::shadow,   Aov::object,        Aov::material, Aov::uv,
                         Aov::distance, Aov::camera_normal, Aov::instance};
    for (const CameraDesc& desc : cameras()) {
        const MovingCamera camera(desc, Camera(desc, size, size));
        const AovPass pass(world, camera, options);
        AovFilm film(region, options.film.aovs);
        IdFilm ids(region, options.film.aovs, pass.names());
        check_costs_nothing_a_sample([&](std::int64_t samples) {
            static_cast<void>(pass.render_tile(whole, {.begin = 0, .end = samples}, film, ids));
        });
        CHECK(ids.ranks()[0] > 2);
    }
}

}  // namespace bdpt::hot_path_test
