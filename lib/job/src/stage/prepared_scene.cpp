#include "stage/prepared_scene.h"

#include <bdpt/default_lights.h>
#include <bdpt/error.h>
#include <bdpt/framing.h>
#include <bdpt/io/read_image.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/io/volume.h>
#include <bdpt/light/studio_environment.h>
#include <bdpt/thread_limit.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include "messages/text.h"
#include "options/groups/view_arguments.h"

namespace bdpt::job {
namespace {

/// Number of copies of a description while a scene is built from it.
enum class Copies : std::uint8_t { one = 1, two = 2 };

// Measured by benchmarks/scale_table.py; checked by tests/apps/files/memory_test.py.
constexpr std::uint64_t light_bytes = 2000;
constexpr std::uint64_t emissive_triangle_bytes = 430;

template <typename T>
std::uint64_t compute_size(const std::vector<T>& values)
{
    return values.size() * sizeof(T);
}

std::uint64_t count_bytes(const std::vector<TexelImage>& images)
{
    std::uint64_t bytes = 0;
    for (const TexelImage& image : images) {
        bytes += image.bytes.size();
    }
    return bytes;
}

std::uint64_t count_bytes(const std::vector<MeshDesc>& meshes)
{
    std::uint64_t bytes = 0;
    for (const MeshDesc& mesh : meshes) {
        bytes += compute_size(mesh.positions) + compute_size(mesh.normals) +
                 compute_size(mesh.tangents) + compute_size(mesh.uvs[0]) +
                 compute_size(mesh.uvs[1]) + compute_size(mesh.colors) +
                 compute_size(mesh.triangles);
        for (const MeshPose& pose : mesh.motion) {
            bytes += compute_size(pose.positions) + compute_size(pose.normals) +
                     compute_size(pose.tangents);
        }
    }
    return bytes;
}

std::uint64_t count_bytes(const std::vector<VolumeDesc>& volumes)
{
    std::uint64_t bytes = 0;
    for (const VolumeDesc& volume : volumes) {
        bytes += compute_size(volume.density);
    }
    return bytes;
}

std::uint64_t emissive_triangles(const SceneDesc& scene)
{
    std::uint64_t count = 0;
    for (const InstanceDesc& instance : scene.instances) {
        const MaterialDesc& material = scene.materials[static_cast<std::size_t>(instance.material)];
        if (material.emission != Rgb(0.0f)) {
            count += scene.meshes[static_cast<std::size_t>(instance.mesh)].triangles.size();
        }
    }
    return count;
}

/// Charges the memory of building a scene beyond that of loading: mipmaps, the light tree, a second
/// copy of all that was loaded. Throws `Error` if that is too much.
void spend_building(io::MemoryBudget& memory, const SceneDesc& scene, Copies copies)
{
    memory.spend(
        "the tables of light sampling",
        scene.lights.size() * light_bytes + emissive_triangles(scene) * emissive_triangle_bytes);
    if (scene.texture_filter == TextureFilter::mip_mapped) {
        memory.spend("the mip maps of images", count_bytes(scene.images) / 3);
    }
    if (copies == Copies::two) {
        memory.spend("a copy of the scene, to choose its lighting",
                     count_bytes(scene.images) + count_bytes(scene.meshes) +
                         count_bytes(scene.volumes) + compute_size(scene.instances));
    }
}

/// Source of light from infinity.
enum class Sky {
    none,
    chosen,     ///< the file's, or that of --env
    standard,   ///< the default one, with a lamp if it does not reach the view
    if_wanted,  ///< the default one, unless emitters give enough light
};

struct LitScene {
    SceneDesc desc;
    Sky sky = Sky::none;
    std::string environment_name = "none";
    std::vector<std::string> warnings{};
    std::vector<Note> notes{};
    std::size_t added = 0;  ///< default lights that were added
    bool has_object_light = false;
};

bool is_environment(const LightDesc& light)
{
    return std::holds_alternative<EnvironmentLightDesc>(light);
}

/// Applies the requested changes to the scene's environment.
void change_environment(LitScene& lit, const RenderArguments& arguments)
{
    const EnvironmentChange& change = arguments.environment_change;
    if (change == EnvironmentChange{}) {
        return;
    }
    if (lit.sky == Sky::none) {
        lit.warnings.push_back(
            fmt::format("{}: no environment: --env-rotation and --env-intensity have no effect",
                        arguments.file.string()));
    }
    for (LightDesc& light : lit.desc.lights) {
        if (auto* environment = std::get_if<EnvironmentLightDesc>(&light)) {
            *environment = changed(std::move(*environment), change);
        }
    }
}

/// Adds the requested environment, replacing the file's own. Whether the default one is needed is
/// decided when the scene is built.
LitScene choose_environment(SceneDesc desc, const RenderArguments& arguments)
{
    LitScene lit{.desc = std::move(desc)};
    const std::string choice = arguments.environment.value_or("");
    if (!choice.empty()) {
        std::erase_if(lit.desc.lights, is_environment);
    }
    if (choice == "none") {
        return lit;
    }
    if (choice == "default" && lit.desc.lights.empty()) {
        lit.sky = Sky::standard;
    } else if (choice == "default") {
        lit.sky = Sky::chosen;
        lit.environment_name = choice;
        lit.desc.lights.emplace_back(default_environment());
    } else if (choice == "object" || choice == "studio") {
        lit.sky = Sky::chosen;
        lit.environment_name = choice;
        lit.desc.lights.emplace_back(choice == "object" ? object_environment()
                                                        : studio_environment());
    } else if (!choice.empty()) {
        io::LoadedEnvironment loaded =
            io::load_environment(choice, {.limits = arguments.scene.limits,
                                          .memory = arguments.scene.memory.get(),
                                          .strict = arguments.scene.strict});
        for (const std::string& warning : loaded.warnings) {
            lit.warnings.push_back(fmt::format("{}: {}", choice, warning));
        }
        lit.sky = Sky::chosen;
        lit.environment_name = choice;
        lit.desc.lights.push_back(std::move(loaded.light));
    } else if (std::any_of(lit.desc.lights.begin(), lit.desc.lights.end(), is_environment)) {
        lit.sky = Sky::chosen;
        lit.environment_name = "scene";
    } else if (lit.desc.lights.empty()) {
        lit.sky = Sky::if_wanted;
    }
    return lit;
}

/// Tests whether `build` may add lights, for which it builds the scene first.
bool is_undecided(const LitScene& lit)
{
    return lit.sky == Sky::standard || lit.sky == Sky::if_wanted;
}

/// Adds the default lights that are missing.
void add_lights(LitScene& lit, DefaultLights missing, const FramedView& framed,
                const std::string& file)
{
    if (lit.sky == Sky::if_wanted && missing == DefaultLights::none) {
        lit.sky = Sky::none;
        return;
    }
    if (lit.sky == Sky::if_wanted) {
        lit.notes.push_back(
            {"default_sky",
             fmt::format("{}: no light{}: lit by {} (--env {})", file,
                         has_light(lit.desc) ? " but emissive materials" : "",
                         environment_text(missing),
                         has_light(lit.desc) ? "none removes it" : "chooses another")});
        ++lit.added;
        lit.has_object_light = missing == DefaultLights::object;
    } else if (missing != DefaultLights::sky_and_lamp) {
        missing = DefaultLights::sky;  // --env default
    }
    lit.environment_name = environment_name(missing);
    lit.desc.lights = default_lights(missing, framed);
    if (missing == DefaultLights::sky_and_lamp) {
        lit.notes.push_back(
            {"default_lamp",
             fmt::format("{}: a closed room without light: a lamp was added at "
                         "{} (--env none removes it)",
                         file, place_text(framed.lamp_position, lit.desc.origin, 3))});
        ++lit.added;
    }
}

/// Builds the scene, with default lights if needed.
Scene build(LitScene& lit, const RenderArguments& arguments)
{
    if (!is_undecided(lit)) {
        change_environment(lit, arguments);
        return Scene(std::move(lit.desc), arguments.isa);
    }
    Scene scene(lit.desc, arguments.isa);
    const FramedView framed = metered_view(scene);
    add_lights(lit, missing_lights(scene, framed), framed, arguments.file.string());
    change_environment(lit, arguments);
    const bool is_lit = !lit.desc.lights.empty();
    return is_lit ? scene.with_lights(std::move(lit.desc.lights)) : std::move(scene);
}

/// Returns the camera that frames the scene as requested. A complete view (--from, --look-at and
/// --fov) needs no framing, which takes longer than a coarse picture.
FramedView framed(const Scene& scene, float aspect, const RenderArguments& arguments)
{
    const ViewOverrides& view = arguments.view;
    if (view.from && view.look_at && view.vertical_fov && !view.frames()) {
        return {.camera = {.name = "auto", .vertical_fov = *view.vertical_fov}};
    }
    FrameOptions options{.direction = view.direction,
                         .margin = view.margin,
                         .projection = view.projection,
                         .whole_turn = arguments.sequence && arguments.sequence->orbit > 0};
    if (!view.from && !view.look_at) {
        options.vertical_fov = view.vertical_fov;
    }
    FramedView result = frame_scene(scene, aspect, options);
    result.camera.name = "auto";
    return result;
}

Vec3 center(const Bounds& bounds)
{
    return 0.5f * (bounds.min + bounds.max);
}

float aspect_of(const Size& size)
{
    return static_cast<float>(size.width) / static_cast<float>(size.height);
}

/// Returns the selected camera of the file; none: the scene is framed.
std::optional<CameraDesc> camera_in_file(const std::vector<CameraDesc>& cameras,
                                         const RenderArguments& arguments)
{
    const bool chosen = arguments.camera.has_value();
    if (arguments.camera == "auto" || arguments.view.frames() || (!chosen && cameras.empty())) {
        return std::nullopt;
    }
    const std::string choice = arguments.camera.value_or("0");
    CameraDesc camera = select_camera(cameras, choice, arguments.file.string());
    camera.name = camera.name.empty() ? choice : camera.name;
    return camera;
}

/// Adds a note if the camera of the file, which nobody has chosen, shows little of the scene.
void note_small_picture(PreparedScene& stage, const RenderArguments& arguments)
{
    const ViewOverrides& view = arguments.view;
    const bool is_chosen = arguments.camera || view.from || view.look_at || view.vertical_fov;
    const bool is_medium = arguments.fog || !stage.scene.description().volumes.empty();
    if (is_chosen || is_medium || arguments.sequence || arguments.sequence_view) {
        return;
    }
    constexpr double little = 0.05;
    double share = 1.0;
    try {
        share = filled_share(stage.scene, stage.camera, aspect_of(stage.size));
    } catch (const Error&) {
        // The renderer refuses this camera by name.
    }
    if (share < little) {
        stage.notes.push_back(
            {"small_scene",
             fmt::format("{}: camera {}: the scene fills {:.2g} % of the image "
                         "(--camera auto frames it)",
                         arguments.file.string(), stage.camera.name, 100.0 * share)});
    }
}

/// Returns what was left out of the meshes, in parentheses; empty if nothing was.
std::string why_no_triangles(const std::vector<std::string>& warnings)
{
    std::string reasons;
    for (const std::string& warning : warnings) {
        if (warning.starts_with("/meshes/")) {
            reasons += (reasons.empty() ? "" : "; ") + warning;
        }
    }
    return reasons.empty() ? "" : " (" + reasons + ")";
}

/// Loads the volume, and adds its warnings. One without any density, such as the first frame of a
/// simulation, is left out.
std::optional<io::LoadedVolume> load_volume(const RenderArguments& arguments,
                                            std::vector<std::string>& warnings)
{
    if (!arguments.volume) {
        return std::nullopt;
    }
    io::VolumeOptions options = arguments.volume->options;
    options.limits = arguments.scene.limits;
    options.memory = arguments.scene.memory;
    io::LoadedVolume loaded = io::load_volume(arguments.volume->file, options);
    for (const std::string& warning : loaded.warnings) {
        warnings.push_back(fmt::format("{}: {}", arguments.volume->file.string(), warning));
    }
    const std::vector<float>& density = loaded.volume.density;
    const bool is_empty =
        std::none_of(density.begin(), density.end(), [](float value) { return value > 0.0f; });
    return is_empty ? std::nullopt : std::optional(std::move(loaded));
}

}  // namespace

EnvironmentLightDesc changed(EnvironmentLightDesc light, const EnvironmentChange& change)
{
    if (change.rotation != 0.0) {
        light = turned(std::move(light),
                       static_cast<float>(change.rotation * std::numbers::pi / 180.0));
    }
    if (change.intensity != 1.0f) {
        light.radiance = light.radiance.scaled(change.intensity);
    }
    return light;
}

PreparedScene prepare_scene(const RenderArguments& asked)
{
    RenderArguments arguments = asked;
    if (!arguments.scene.memory) {
        arguments.scene.memory = std::make_shared<io::MemoryBudget>(asked.memory);
    }
    const auto start = std::chrono::steady_clock::now();
    const std::string file = arguments.file.string();
    const ThreadLimit threads = limit_threads(arguments.options.system.threads);
    std::vector<std::string> warnings;
    std::optional<io::LoadedVolume> volume = load_volume(arguments, warnings);
    io::LoadedScene loaded = io::load_gltf(arguments.file, arguments.scene);

    if (threads.allowed < threads.wanted) {
        warnings.push_back(
            fmt::format("using {} of {} threads: the system limits how many this user or container "
                        "may have",
                        threads.allowed, threads.wanted));
    }
    for (const std::string& warning : loaded.warnings) {
        warnings.push_back(fmt::format("{}: {}", file, warning));
    }
    if (!has_surface(loaded.scene)) {
        throw Error(
            ErrorCode::invalid_input,
            fmt::format("{}: the scene is empty: it has no triangles and no light with a radius{}",
                        file, why_no_triangles(loaded.warnings)));
    }
    const std::optional<CameraDesc> from_file = camera_in_file(loaded.cameras, arguments);
    const Size size =
        arguments.size.value_or(default_size(from_file ? from_file->aspect_ratio : std::nullopt));
    loaded.scene.texture_filter = arguments.texture_filter;
    loaded.scene.contacts = arguments.contacts;
    loaded.scene.fog = arguments.fog;
    if (volume) {
        volume->volume.world_from_grid[3] =
            Vec4(to_world(volume->translation, loaded.scene.origin), 1.0f);
        loaded.scene.volumes.push_back(std::move(volume->volume));
    }
    LitScene lit = choose_environment(std::move(loaded.scene), arguments);
    for (const std::string& note : loaded.notes) {
        lit.notes.push_back({"draft_extension", fmt::format("{}: {}", file, note)});
    }
    spend_building(*arguments.scene.memory, lit.desc,
                   is_undecided(lit) ? Copies::two : Copies::one);
    const auto loading_end = std::chrono::steady_clock::now();
    Scene scene = build(lit, arguments);
    const auto building_end = std::chrono::steady_clock::now();
    for (const std::string& warning : scene.warnings()) {
        warnings.push_back(fmt::format("{}: {}", file, warning));
    }
    warnings.insert(warnings.end(), lit.warnings.begin(), lit.warnings.end());
    if (const std::size_t pairs = scene.counts().contacts) {
        const std::size_t bonds = scene.counts().bonds;
        lit.notes.push_back(
            {"contacts",
             fmt::format("{}: {} of bodies touch: {}", file, counted(pairs, "pair"),
                         bonds == 0       ? "a thin film of air is between them"
                         : bonds == pairs ? "they are bonded"
                                          : fmt::format("{} bonded, a thin film of air is between "
                                                        "the others",
                                                        bonds))});
    }
    const auto seconds = [](std::chrono::steady_clock::duration time) {
        return std::chrono::duration<double>(time).count();
    };
    const std::size_t lights = scene.counts().lights - lit.added;
    PreparedScene stage{std::move(scene),
                        {},
                        lit.environment_name,
                        size,
                        std::move(warnings),
                        std::move(lit.notes),
                        seconds(loading_end - start),
                        seconds(building_end - loading_end),
                        std::move(loaded.facts),
                        lights,
                        lit.has_object_light,
                        !from_file.has_value(),
                        std::move(loaded.cameras),
                        std::move(loaded.files),
                        *arguments.scene.memory};
    const Viewpoint seen = viewpoint(stage, arguments);
    stage.camera = seen.camera;
    if (seen.is_framed && !arguments.camera && !arguments.view.from && !arguments.view.frames()) {
        const Vec3 eye(seen.camera.world_from_camera[3]);
        const std::string place = place_text(eye, stage.scene.description().origin, 3);
        stage.notes.push_back(
            {"framed",
             fmt::format("{}: no camera: {} (--view, or --from and --look-at, choose another view)",
                         file,
                         seen.is_inside ? "a closed room, seen from " + place
                                        : "the whole scene is framed")});
    }
    if (from_file) {
        note_small_picture(stage, arguments);
    }
    return stage;
}

Viewpoint viewpoint(const PreparedScene& stage, std::size_t index, const RenderArguments& arguments)
{
    CameraDesc camera = apply(arguments.view, stage.cameras.at(index), std::nullopt,
                              stage.scene.description().origin);
    camera.name = camera_names(stage).at(index);
    const Size size = arguments.size.value_or(default_size(camera.aspect_ratio));
    return {.camera = with_lens(arguments.lens, std::move(camera), stage.scene, size),
            .size = size};
}

Viewpoint viewpoint(const PreparedScene& stage, const RenderArguments& arguments)
{
    const std::optional<CameraDesc> from_file = camera_in_file(stage.cameras, arguments);
    const Size size =
        arguments.size.value_or(default_size(from_file ? from_file->aspect_ratio : std::nullopt));
    const DVec3 origin = stage.scene.description().origin;
    const FramedView view = from_file ? FramedView{.camera = *from_file}
                                      : framed(stage.scene, aspect_of(size), arguments);
    CameraDesc camera =
        apply(arguments.view, view.camera,
              from_file ? std::nullopt : std::optional(center(stage.scene.bounds())), origin);
    return {.camera = with_lens(arguments.lens, std::move(camera), stage.scene, size),
            .size = size,
            .is_framed = !from_file.has_value(),
            .is_inside = view.inside};
}

std::string size_text(const PreparedScene& stage)
{
    const SceneCounts counts = stage.scene.counts();
    const std::string emissive = counts.emissive_triangles > 0
                                     ? fmt::format(" ({} emissive)", counts.emissive_triangles)
                                     : "";
    return fmt::format(
        "{}{}, {}", counted(counts.instanced_triangles, "triangle"), emissive,
        counted(stage.lights - std::min(stage.lights, counts.emissive_triangles), "light"));
}

const char* environment_name(DefaultLights lights)
{
    return lights == DefaultLights::object ? "object" : "default";
}

const char* environment_text(DefaultLights lights)
{
    return lights == DefaultLights::object ? "a key and a rim light" : "a soft sky";
}

bool adds_ground(const RenderArguments& arguments, const PreparedScene& stage)
{
    return arguments.may_add_ground && stage.has_object_light;
}

RenderArguments with_screen_aov(RenderArguments arguments, Aov aov)
{
    arguments.options.film.aovs.insert(aov);
    arguments.screen_aovs.push_back(aov);
    return arguments;
}

bool has_environment(const PreparedScene& stage)
{
    return stage.environment_name != "none";
}

std::vector<std::string> camera_names(const PreparedScene& stage)
{
    std::vector<std::string> names;
    for (const CameraDesc& camera : stage.cameras) {
        names.push_back(camera.name.empty() ? std::to_string(names.size()) : camera.name);
    }
    return names;
}

}  // namespace bdpt::job
