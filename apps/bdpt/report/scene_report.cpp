#include "report/reports.h"

#include <bdpt/default_lights.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>
#include <variant>

#include "messages/text.h"
#include "output/values.h"

namespace bdpt::app {
namespace {

using nlohmann::ordered_json;

/// Short name of a kind: "point" of "point light".
template <typename Light>
constexpr std::string_view short_kind = Light::kind.substr(0, Light::kind.rfind(" light"));

/// Text around the value of a field.
struct Phrase {
    std::string before;
    std::string_view after;
};

Phrase find_phrase(std::string_view field)
{
    if (field == "position") {
        return {" at ", ""};
    }
    if (field == "direction") {
        return {" towards ", ""};
    }
    if (field == "intensity") {
        return {", ", " cd"};
    }
    if (field == "illuminance") {
        return {", ", " lx"};
    }
    return {fmt::format(", {} ", field), ""};
}

std::string radius_text(float metres)
{
    return metres > 0.0f ? fmt::format(", radius {:.4g} m", metres) : "";
}

// A kind without its own text is described by its fields: all numbers and vectors, but no motion.

/// Returns what to add to a field: only positions depend on the origin.
DVec3 shift_of_field(std::string_view field, const DVec3& origin)
{
    return field == "position" ? origin : DVec3(0.0);
}

/// Returns a light as a line for people.
struct LightText {
    DVec3 origin;

    template <typename Light>
    std::string operator()(const Light& light) const
    {
        std::string text = fmt::format("{} \"{}\"", short_kind<Light>, light.name);
        for_each_field(light, [&text, this]<typename T>(const auto& field, const T& value) {
            if constexpr (std::is_same_v<T, Vec3>) {
                const auto [before, after] = find_phrase(field.name);
                text += fmt::format("{}{}{}", before,
                                    to_text(value, shift_of_field(field.name, origin)), after);
            } else if constexpr (std::is_arithmetic_v<T>) {
                text += field.name == "radius" ? radius_text(value)
                                               : fmt::format(", {} {:.4g}", field.name, value);
            }
        });
        return text;
    }
    std::string operator()(const SpotLightDesc& light) const
    {
        return fmt::format("spot \"{}\" at {}, {} cd, cone {:.3g} to {:.3g} degrees{}", light.name,
                           to_text(light.position, origin), to_text(light.intensity),
                           degrees(light.inner_cone_angle), degrees(light.outer_cone_angle),
                           radius_text(light.radius));
    }
    std::string operator()(const ProfileLightDesc& light) const
    {
        return fmt::format("profile {} \"{}\" at {}, times {}",
                           static_cast<std::size_t>(light.profile), light.name,
                           to_text(light.position, origin), to_text(light.scale));
    }
    std::string operator()(const EnvironmentLightDesc& light) const
    {
        return fmt::format("environment {}x{}", light.radiance.width(), light.radiance.height());
    }
};

/// Returns a light as an object: "kind" and its properties by kind.
struct LightJson {
    DVec3 origin;

    template <typename Light>
    ordered_json operator()(const Light& light) const
    {
        ordered_json result{{"kind", short_kind<Light>}, {"name", light.name}};
        for_each_field(light, [&result, this]<typename T>(const auto& field, const T& value) {
            std::string name(field.name);
            std::replace(name.begin(), name.end(), ' ', '_');
            if constexpr (std::is_same_v<T, Vec3>) {
                result[name] = to_json(value, shift_of_field(field.name, origin));
            } else if constexpr (std::is_arithmetic_v<T>) {
                result[name] = value;
            }
        });
        return result;
    }
    ordered_json operator()(const SpotLightDesc& light) const
    {
        return {{"kind", "spot"},
                {"name", light.name},
                {"position", to_json(light.position, origin)},
                {"direction", to_json(light.direction)},
                {"intensity", to_json(light.intensity)},
                {"inner_cone_degrees", degrees(light.inner_cone_angle)},
                {"outer_cone_degrees", degrees(light.outer_cone_angle)},
                {"radius", light.radius}};
    }
    ordered_json operator()(const ProfileLightDesc& light) const
    {
        return {{"kind", "profile"},
                {"name", light.name},
                {"position", to_json(light.position, origin)},
                {"profile", static_cast<std::size_t>(light.profile)},
                {"scale", to_json(light.scale)}};
    }
    ordered_json operator()(const EnvironmentLightDesc& light) const
    {
        return {{"kind", "environment"},
                {"width", light.radiance.width()},
                {"height", light.radiance.height()}};
    }
};

/// Returns `light` without the pixels of an environment.
LightDesc without_pixels(const LightDesc& light)
{
    if (const auto* environment = std::get_if<EnvironmentLightDesc>(&light)) {
        return EnvironmentLightDesc{.radiance = Image{.width = environment->radiance.width(),
                                                      .height = environment->radiance.height(),
                                                      .pixels = {}}};
    }
    return light;
}

/// Groups equal sizes as "3 of 1024x1024".
std::string summary(const std::vector<Size>& sizes)
{
    std::map<std::string, std::size_t> counts;
    for (const Size& size : sizes) {
        ++counts[fmt::format("{}x{}", size.width, size.height)];
    }
    std::string result;
    for (const auto& [word, count] : counts) {
        result += fmt::format("{}{}{}", result.empty() ? "" : ", ",
                              count > 1 ? fmt::format("{} of ", count) : "", word);
    }
    return result;
}

/// The report as lines "name   value", with long lists truncated.
class Lines {
public:
    void add(std::string_view name, std::string_view value)
    {
        text_ += one_line(fmt::format("{:<12}{}", name, value)) + "\n";
    }
    void add_list(std::string_view name, const std::vector<std::string>& values)
    {
        constexpr std::size_t max_listed = 20;
        for (std::size_t i = 0; i < std::min(values.size(), max_listed); ++i) {
            add(i == 0 ? name : "", values[i]);
        }
        if (values.size() > max_listed) {
            add("", fmt::format("... and {} more (--json has all)", values.size() - max_listed));
        }
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string text_;
};

std::string lens_text(const CameraDesc& camera)
{
    return camera.lens_radius > 0.0f ? fmt::format(", lens radius {:.4g} m, focused at {:.4g} m",
                                                   camera.lens_radius, camera.focus_distance)
                                     : "";
}

std::string view_text(const CameraDesc& camera)
{
    return camera.projection == Projection::orthographic
               ? fmt::format("orthographic, {:.4g} m high", camera.vertical_extent)
               : fmt::format("perspective, vertical field of view {:.4g} degrees{}",
                             degrees(camera.vertical_fov), lens_text(camera));
}

std::vector<std::string> camera_lines(const std::vector<CameraDesc>& cameras, const DVec3& origin)
{
    std::vector<std::string> lines;
    for (const CameraDesc& camera : cameras) {
        std::string aspect;
        if (camera.aspect_ratio) {
            aspect = fmt::format(", aspect ratio {:.4g}", *camera.aspect_ratio);
        }
        lines.push_back(fmt::format("{} \"{}\" at {}, {}{}", lines.size(), camera.name,
                                    to_text(Vec3(camera.world_from_camera[3]), origin),
                                    view_text(camera), aspect));
    }
    return lines;
}

std::vector<std::string> extension_lines(const std::vector<io::ExtensionUse>& extensions)
{
    std::vector<std::string> lines;
    for (const io::ExtensionUse& extension : extensions) {
        lines.push_back(fmt::format("{}: {}{}{}{}", extension.name, io::to_string(extension.status),
                                    extension.required ? ", required" : "",
                                    extension.note.empty() ? "" : "; ", extension.note));
    }
    return lines;
}

std::vector<std::string> scene_lines(const io::GltfFacts& facts)
{
    std::vector<std::string> lines;
    for (const std::string& name : facts.scene_names) {
        lines.push_back(fmt::format("{} \"{}\"{}", lines.size(), name,
                                    facts.scene == lines.size() ? " (this one)" : ""));
    }
    return lines;
}

/// Returns 0 "first", 1 "second" ...
std::vector<std::string> numbered(const std::vector<std::string>& names)
{
    std::vector<std::string> lines;
    for (const std::string& name : names) {
        lines.push_back(fmt::format("{} \"{}\"", lines.size(), name));
    }
    return lines;
}

ordered_json camera_json(const CameraDesc& camera, const DVec3& origin)
{
    ordered_json result{{"name", camera.name},
                        {"position", to_json(Vec3(camera.world_from_camera[3]), origin)}};
    add_projection(result, camera);
    result["aspect_ratio"] = or_null(camera.aspect_ratio);
    return result;
}

ordered_json extension_json(const io::ExtensionUse& extension)
{
    return {{"name", extension.name},
            {"status", io::to_string(extension.status)},
            {"required", extension.required},
            {"note", extension.note}};
}

template <typename Items, typename Convert>
ordered_json make_array(const Items& items, Convert convert)
{
    ordered_json result = ordered_json::array();
    for (const auto& item : items) {
        result.push_back(convert(item));
    }
    return result;
}

/// Describes the defaults that a render would fill in.
std::vector<std::string> default_lines(const Defaults& defaults)
{
    std::vector<std::string> lines;
    if (defaults.camera) {
        lines.emplace_back("no camera: a render frames the whole scene");
    }
    if (defaults.sky) {
        lines.emplace_back(defaults.glows ? "no light but emissive materials: a render adds lights"
                                          : "no light: a render adds lights");
    }
    if (defaults.lamp) {
        lines.emplace_back("a closed room without light: a render adds a lamp");
    }
    return lines;
}

ordered_json default_names(const Defaults& defaults)
{
    ordered_json names = ordered_json::array();
    for (const auto& [is_missing, name] :
         {std::pair{defaults.camera, "camera"}, {defaults.sky, "sky"}, {defaults.lamp, "lamp"}}) {
        if (is_missing) {
            names.push_back(name);
        }
    }
    return names;
}

/// Adds the contents of the file, of which only a part may be used.
void add_file(Lines& lines, const SceneReport& report)
{
    const io::GltfFacts& facts = report.facts;
    lines.add("file", report.file);
    lines.add("glTF", facts.version);
    if (!facts.generator.empty()) {
        lines.add("generator", facts.generator);
    }
    if (!facts.copyright.empty()) {
        lines.add("copyright", facts.copyright);
    }
    lines.add_list("scenes", scene_lines(facts));
}

/// Adds the contents of a file that cannot be loaded, used or not.
void add_contents(Lines& lines, const io::GltfFacts& facts)
{
    lines.add("nodes", fmt::format("{}", facts.nodes));
    lines.add("meshes", fmt::format("{} of {} primitives", facts.meshes, facts.primitives));
    lines.add("materials", fmt::format("{}", facts.materials));
    lines.add("textures", fmt::format("{} of {} images", facts.textures, facts.images));
    lines.add("cameras", fmt::format("{}", facts.cameras));
    lines.add("lights", fmt::format("{}", facts.lights));
}

/// Adds the contents of the loaded scene.
void add_scene(Lines& lines, const SceneReport& report)
{
    const io::GltfFacts& facts = report.facts;
    if (report.knowledge == Knowledge::built) {
        const SceneCounts& counts = report.counts;
        lines.add("triangles",
                  fmt::format("{} in meshes, {} in the scene ({} without area, {} emit)",
                              counts.triangles, counts.instanced_triangles,
                              counts.degenerate_triangles, counts.emissive_triangles));
        if (counts.contacts > 0) {
            lines.add("contacts", fmt::format("{} of bodies", counted(counts.contacts, "pair")));
        }
    }
    lines.add("instances",
              fmt::format("{} ({} nodes, {} meshes of {} primitives)", report.instances,
                          facts.nodes, facts.meshes, facts.primitives));
    if (report.bounds) {
        lines.add("bounds", fmt::format("{} to {} m", to_text(report.bounds->min, report.origin),
                                        to_text(report.bounds->max, report.origin)));
    }
    lines.add("materials", fmt::format("{}", facts.materials));
    std::vector<std::string> emissive;
    for (const EmissiveMaterial& material : report.emissive) {
        emissive.push_back(
            fmt::format("\"{}\" emits {} nit", material.name, to_text(material.emission)));
    }
    lines.add_list("", emissive);
    lines.add("textures",
              fmt::format("{} of {} images{}{}", facts.textures, facts.images,
                          report.texture_sizes.empty() ? "" : ": ", summary(report.texture_sizes)));
    lines.add_list("cameras", camera_lines(report.cameras, report.origin));
    std::vector<std::string> lights;
    for (const LightDesc& light : report.lights) {
        lights.push_back(std::visit(LightText{report.origin}, light));
    }
    lines.add_list("lights", lights);
}

/// Returns the facts that need a loaded scene; null for each if it could not be loaded.
ordered_json scene_json(const SceneReport& report)
{
    ordered_json result;
    const SceneCounts& counts = report.counts;
    result["triangles"] = report.knowledge == Knowledge::built
                              ? ordered_json{{"in_meshes", counts.triangles},
                                             {"in_scene", counts.instanced_triangles},
                                             {"degenerate", counts.degenerate_triangles},
                                             {"emissive", counts.emissive_triangles}}
                              : ordered_json();
    result["contacts"] =
        report.knowledge == Knowledge::built ? ordered_json(counts.contacts) : ordered_json();
    result["bounds"] = report.bounds
                           ? ordered_json{{"min", to_json(report.bounds->min, report.origin)},
                                          {"max", to_json(report.bounds->max, report.origin)}}
                           : ordered_json();
    if (report.knowledge == Knowledge::facts) {
        for (const char* name : {"materials", "emissive_materials", "texture_sizes", "cameras",
                                 "lights", "warnings", "defaults"}) {
            result[name] = nullptr;
        }
        return result;
    }
    result["materials"] = report.materials;
    result["emissive_materials"] =
        make_array(report.emissive, [](const EmissiveMaterial& material) -> ordered_json {
            return {{"name", material.name}, {"emission", to_json(material.emission)}};
        });
    result["texture_sizes"] = make_array(report.texture_sizes, [](const Size& size) {
        return ordered_json::array({size.width, size.height});
    });
    result["cameras"] = make_array(report.cameras, [&report](const CameraDesc& camera) {
        return camera_json(camera, report.origin);
    });
    result["lights"] = make_array(report.lights, [&report](const LightDesc& light) {
        return std::visit(LightJson{report.origin}, light);
    });
    result["warnings"] = report.warnings;
    result["defaults"] = default_names(report.defaults);
    return result;
}

}  // namespace

SceneReport make_report(const std::string& file, const io::LoadedScene& loaded)
{
    SceneReport report;
    report.knowledge = Knowledge::loaded;
    report.file = file;
    report.facts = loaded.facts;
    report.cameras = loaded.cameras;
    report.origin = loaded.scene.origin;
    report.warnings = loaded.warnings;
    report.instances = loaded.scene.instances.size();
    for (const LightDesc& light : loaded.scene.lights) {
        report.lights.push_back(without_pixels(light));
    }
    for (const MaterialDesc& material : loaded.scene.materials) {
        report.materials.push_back(material.name);
        if (material.emission != Rgb(0.0f)) {
            report.emissive.push_back({.name = material.name, .emission = material.emission});
        }
    }
    for (const TexelImage& image : loaded.scene.images) {
        report.texture_sizes.push_back({.width = image.width, .height = image.height});
    }
    report.defaults.camera = loaded.cameras.empty();
    report.defaults.sky = !has_light(loaded.scene);
    report.defaults.glows = loaded.scene.lights.empty() && !report.defaults.sky;
    return report;
}

std::string info_text(const SceneReport& report)
{
    const io::GltfFacts& facts = report.facts;
    Lines lines;
    add_file(lines, report);
    if (report.knowledge == Knowledge::facts) {
        add_contents(lines, facts);
    } else {
        add_scene(lines, report);
    }
    lines.add_list("extensions", extension_lines(facts.extensions));
    lines.add_list("variants", numbered(facts.variant_names));
    lines.add_list("animations", numbered(facts.animation_names));
    if (facts.skins > 0) {
        lines.add("skins", fmt::format("{}", facts.skins));
    }
    lines.add_list("warnings", report.warnings);
    lines.add_list("defaults", default_lines(report.defaults));
    if (report.problem) {
        lines.add("rendering",
                  fmt::format("would fail with exit code {}: {}",
                              static_cast<int>(report.problem->code), report.problem->message));
    }
    return lines.text();
}

ordered_json info_json(const SceneReport& report)
{
    const io::GltfFacts& facts = report.facts;
    ordered_json result{{"file", report.file},
                        {"gltf_version", facts.version},
                        {"generator", facts.generator},
                        {"copyright", facts.copyright},
                        {"scenes", facts.scene_names}};
    result["scene"] = or_null(facts.scene);
    result["counts"] = {{"nodes", facts.nodes},           {"meshes", facts.meshes},
                        {"primitives", facts.primitives}, {"instances", report.instances},
                        {"materials", facts.materials},   {"textures", facts.textures},
                        {"images", facts.images},         {"skins", facts.skins},
                        {"animations", facts.animations}, {"punctual_lights", facts.lights},
                        {"cameras", facts.cameras}};
    if (report.knowledge == Knowledge::facts) {
        result["counts"]["instances"] = nullptr;
    }
    result["variants"] = facts.variant_names;
    result["animations"] = facts.animation_names;
    result.update(scene_json(report));
    result["extensions"] = make_array(facts.extensions, extension_json);
    result["renderable"] = !report.problem;
    result["problem"] = report.problem
                            ? ordered_json{{"code", static_cast<int>(report.problem->code)},
                                           {"message", report.problem->message}}
                            : ordered_json();
    return result;
}

}  // namespace bdpt::app
