#include "fuzz_target.h"
#include "input_file.h"
#include "promises.h"

#include <bdpt/framing.h>
#include <bdpt/io/gltf.h>
#include <bdpt/render.h>
#include <bdpt/tools/scene_builder.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>
#include <variant>

using namespace bdpt;

namespace {

EnvironmentLightDesc grey_sky()
{
    EnvironmentLightDesc sky;
    sky.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(0.5f)}};
    return sky;
}

/// What of the steps that trace thousands of rays, and so take longer than all else here, an input
/// takes. The bytes of the input decide, not its scene: mutants of a scene differ.
enum class LongStep { none, framing, learning };

LongStep choose_long_step(std::string_view input)
{
    switch (std::hash<std::string_view>{}(input) % 16) {
        case 0:
            return LongStep::framing;
        case 1:
            return LongStep::learning;
        default:
            return LongStep::none;
    }
}

/// A camera for scenes without one.
CameraDesc choose_camera(const Scene& scene, LongStep step)
{
    if (step == LongStep::framing) {
        return frame_scene(scene, 1.0f).camera;
    }
    const Vec3 center = 0.5f * scene.bounds().min + 0.5f * scene.bounds().max;
    const Vec3 half = scene.bounds().max - center;
    return look_at(center + 3.0f * half + 0.1f * abs(center) + 1.0f, center);
}

/// Four paths, one for each pixel.
void render_four(io::LoadedScene loaded, LongStep step)
{
    const bool has_sky = std::any_of(
        loaded.scene.lights.begin(), loaded.scene.lights.end(),
        [](const LightDesc& light) { return std::holds_alternative<EnvironmentLightDesc>(light); });
    if (!has_sky) {
        loaded.scene.lights.emplace_back(grey_sky());
    }
    const Scene scene(std::move(loaded.scene));
    const CameraDesc camera =
        loaded.cameras.empty() ? choose_camera(scene, step) : loaded.cameras.front();
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.film.width = 2;
    options.film.height = 2;
    options.sampling.samples = {0, 1};
    options.transport.max_depth = 4;
    if (step != LongStep::learning) {
        options.sampling.environment = EnvironmentSampling::compensated;
    }
    options.system.threads = 1;
    const Image image = render(scene, camera, options).film.develop();
    for (const Rgb& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) {
            fuzz::promise(std::isfinite(pixel[c]), "pixels are finite");
        }
    }
}

void load_and_render(const std::filesystem::path& file, const io::GltfOptions& options,
                     LongStep step)
{
    try {
        render_four(io::load_gltf(file, options), step);
    } catch (const Error& error) {
        fuzz::check_refusal(error);
    }
}

}  // namespace

/// From a file to four paths of light: at rest, and with animations and a variant of materials.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::InputFile input;
    const std::filesystem::path file = input.write(data, size);
    const LongStep step = choose_long_step({reinterpret_cast<const char*>(data), size});
    io::GltfOptions options;
    options.limits = fuzz::small_limits;
    std::size_t variants = 0;
    std::size_t animations = 0;
    try {
        io::LoadedScene loaded = io::load_gltf(file, options);
        variants = loaded.facts.variant_names.size();
        animations = loaded.facts.animation_names.size();
        render_four(std::move(loaded), step);
    } catch (const Error& error) {
        fuzz::check_refusal(error);
    }
    if (animations + variants > 0) {
        options.animation = animations > 0 ? std::optional<std::string>("all") : std::nullopt;
        options.time = animations > 0 ? std::optional(0.4) : std::nullopt;
        options.variant = variants > 0 ? std::optional<std::string>("0") : std::nullopt;
        load_and_render(file, options, step);
    }
    return 0;
}
