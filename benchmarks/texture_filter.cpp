// Measures the effect of mipmaps: time, memory and error of renders of a room whose walls have
// large textures, against lookups in the full-resolution textures.

#include <bdpt/io/environment.h>
#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "subject.h"

namespace {

using namespace bdpt;

struct Settings {
    std::vector<std::string> scenes;
    std::vector<int> sizes{512, 4096, 8192};
    SubjectSettings subject{.size = 96, .max_depth = 6, .reference_samples = 1024};
    eval::EqualTimeOptions contest;
};

/// Returns noise over stripes, such as plaster over bricks.
TexelImage pattern(int size, unsigned seed)
{
    TexelImage image{.width = size, .height = size, .bytes = {}, .channels = 3};
    std::minstd_rand random(seed);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const auto noise = static_cast<unsigned>(random()) >> 8U;
            const unsigned brick = (y * 24 / size + x * 12 / size) % 2 == 0 ? 80 : 120;
            for (unsigned c = 0; c < 3; ++c) {
                image.bytes.push_back(static_cast<std::uint8_t>(brick + (noise >> (5 * c)) % 128));
            }
        }
    }
    return image;
}

void add_quad(SceneDesc& scene, const std::array<Vec3, 4>& corners, const MaterialDesc& material)
{
    MeshDesc mesh;
    mesh.positions.assign(corners.begin(), corners.end());
    mesh.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(material);
    InstanceDesc instance;
    instance.mesh = static_cast<MeshId>(scene.meshes.size() - 1);
    instance.material = static_cast<MaterialId>(scene.materials.size() - 1);
    scene.instances.push_back(std::move(instance));
}

/// Returns a room of 2 m a side with textures of colour and roughness on each of its walls.
SceneDesc room(int size)
{
    SceneDesc scene;
    const auto next_image = [&scene] { return static_cast<ImageId>(scene.images.size()); };
    const auto wall = [&](const std::array<Vec3, 4>& corners) {
        MaterialDesc material;
        material.metallic = 0.0f;
        material.base_color_texture = TextureRef{.image = next_image()};
        scene.images.push_back(pattern(size, static_cast<unsigned>(scene.images.size()) + 1));
        material.metallic_roughness_texture = TextureRef{.image = next_image()};
        scene.images.push_back(pattern(size, static_cast<unsigned>(scene.images.size()) + 1));
        add_quad(scene, corners, material);
    };
    wall({Vec3(-1, -1, 1), {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}});
    wall({Vec3(-1, -1, -1), {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}});
    wall({Vec3(-1, -1, 1), {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}});
    wall({Vec3(1, -1, -1), {1, -1, 1}, {1, 1, 1}, {1, 1, -1}});
    MaterialDesc lamp;
    lamp.emission = Rgb(10.0f);
    add_quad(scene,
             {Vec3(-0.3f, 0.99f, -0.3f),
              {0.3f, 0.99f, -0.3f},
              {0.3f, 0.99f, 0.3f},
              {-0.3f, 0.99f, 0.3f}},
             lamp);
    return scene;
}

CameraDesc room_camera()
{
    CameraDesc camera;
    camera.world_from_camera[3] = Vec4(0.0f, 0.0f, 3.4f, 1.0f);
    camera.vertical_fov = 0.75f;
    return camera;
}

Subject make_subject(std::string name, SceneDesc desc, const CameraDesc& camera,
                     const Settings& settings)
{
    RenderOptions options;
    options.film.width = settings.subject.size;
    options.film.height = settings.subject.size;
    options.transport.max_depth = settings.subject.max_depth;
    options.system.threads = settings.subject.threads;
    return {std::move(name), Scene(std::move(desc)), camera, options};
}

/// Returns the resident memory of this process [MB].
double memory()
{
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word) {
        if (word == "VmRSS:") {
            double kilobytes = 0.0;
            status >> kilobytes;
            return kilobytes / 1e3;
        }
    }
    return 0.0;
}

void measure(const std::string& name, const SceneDesc& desc, const CameraDesc& camera,
             const Settings& settings)
{
    const double before = memory();
    const Subject plain = make_subject(name, desc, camera, settings);
    const double with_plain = memory();
    SceneDesc mipped_desc = desc;
    mipped_desc.texture_filter = TextureFilter::mip_mapped;
    const Subject mipped = make_subject(name, std::move(mipped_desc), camera, settings);
    const double with_mipped = memory();
    const eval::Reference reference = make_reference(plain, settings.subject.reference_samples);
    std::printf("  scene: %.0f MB as it is, %.0f MB with copies\n", with_plain - before,
                with_mipped - with_plain);
    for (const auto& [kind, kind_name] :
         {std::pair(IntegratorKind::mis, "mis"), std::pair(IntegratorKind::bdpt, "bdpt")}) {
        std::array<eval::Score, 2> scores;
        std::size_t i = 0;
        for (const Subject* subject : {&plain, &mipped}) {
            eval::Variant variant{.name = kind_name, .options = subject->options};
            variant.options.integrator = kind;
            scores[i++] = eval::compare_at_equal_time(subject->bench_scene(), reference,
                                                      std::span(&variant, 1), settings.contest)
                              .front();
        }
        const auto& [as_it_is, copies] = scores;
        std::printf(
            "  %-4s relMSE: as it is %.3e, copies %.3e, ratio %.3f; time ratio %.3f, at "
            "equal time %.3f\n",
            kind_name, as_it_is.error.median, copies.error.median,
            copies.error.median / as_it_is.error.median,
            copies.sample_seconds / as_it_is.sample_seconds,
            copies.error.median * copies.sample_seconds /
                (as_it_is.error.median * as_it_is.sample_seconds));
    }
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Time, memory and error of mip-mapped textures against textures as they are"};
    app.add_option("scenes", settings.scenes,
                   "glTF files; a room with large textures if not given");
    app.add_option("--sizes", settings.sizes, "Texels a side of the room's textures")
        ->capture_default_str();
    add_sample_options(app, settings.contest);
    add_options(app, settings.subject);
    add_reference_option(app, settings.subject);
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        for (const std::string& scene : settings.scenes) {
            io::LoadedScene loaded = io::load_gltf(scene);
            if (!settings.subject.environment.empty()) {
                loaded.scene.lights.emplace_back(
                    io::load_environment(settings.subject.environment).light);
            }
            const Subject framed = load_subject(scene, settings.subject);
            measure(framed.name, loaded.scene, framed.camera, settings);
        }
        for (const int size : settings.scenes.empty() ? settings.sizes : std::vector<int>()) {
            measure("room of " + std::to_string(size), room(size), room_camera(), settings);
        }
        return 0;
    });
}
