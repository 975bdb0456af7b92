#include "report/scene_report.h"

#include <bdpt/default_lights.h>
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <variant>

#include "terminal/text.h"

namespace bdpt::app {
namespace {

using nlohmann::ordered_json;

double degrees(float radians)
{
    return static_cast<double>(radians) * 180.0 / std::numbers::pi;
}

std::string to_text(Vec3 v)
{
    return fmt::format("{:.4g},{:.4g},{:.4g}", v.x, v.y, v.z);
}

ordered_json to_json(Vec3 v)
{
    return ordered_json::array({v.x, v.y, v.z});
}

struct LightText {
    static std::string radius(float metres)
    {
        return metres > 0.0f ? fmt::format(", radius {:.4g} m", metres) : "";
    }
    std::string operator()(const PointLightDesc& light) const
    {
        return fmt::format("point \"{}\" at {}, {} cd{}", light.name, to_text(light.position),
                           to_text(light.intensity), radius(light.radius));
    }
    std::string operator()(const SpotLightDesc& light) const
    {
        return fmt::format("spot \"{}\" at {}, {} cd, cone {:.3g} to {:.3g} degrees{}", light.name,
                           to_text(light.position), to_text(light.intensity),
                           degrees(light.inner_cone_angle), degrees(light.outer_cone_angle),
                           radius(light.radius));
    }
    std::string operator()(const DirectionalLightDesc& light) const
    {
        return fmt::format("directional \"{}\" towards {}, {} lx", light.name,
                           to_text(light.direction), to_text(light.illuminance));
    }
    std::string operator()(const ProfileLightDesc& light) const
    {
        return fmt::format("profile {} \"{}\" at {}, times {}",
                           static_cast<std::size_t>(light.profile), light.name,
                           to_text(light.position), to_text(light.scale));
    }
    std::string operator()(const EnvironmentLightDesc& light) const
    {
        return fmt::format("environment {}x{}", light.radiance.width, light.radiance.height);
    }
};

/// Equal ones as "3 of 1024x1024".
std::string summary(const std::vector<std::string>& words)
{
    std::map<std::string, std::size_t> counts;
    for (const std::string& word : words) {
        ++counts[word];
    }
    std::string result;
    for (const auto& [word, count] : counts) {
        result += fmt::format("{}{}{}", result.empty() ? "" : ", ",
                              count > 1 ? fmt::format("{} of ", count) : "", word);
    }
    return result;
}

/// The report as lines "name   value", long lists cut.
class Lines {
public:
    void add(std::string_view name, std::string_view value)
    {
        text_ += one_line(fmt::format("{:<12}{}", name, value)) + "\n";
    }
    void add_list(std::string_view name, const std::vector<std::string>& values)
    {
        constexpr std::size_t longest_list = 20;
        for (std::size_t i = 0; i < std::min(values.size(), longest_list); ++i) {
            add(i == 0 ? name : "", values[i]);
        }
        if (values.size() > longest_list) {
            add("", fmt::format("... and {} more (--json has all)", values.size() - longest_list));
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

std::vector<std::string> camera_lines(const std::vector<CameraDesc>& cameras)
{
    std::vector<std::string> lines;
    for (const CameraDesc& camera : cameras) {
        std::string aspect;
        if (camera.aspect_ratio) {
            aspect = fmt::format(", aspect ratio {:.4g}", *camera.aspect_ratio);
        }
        lines.push_back(fmt::format("{} \"{}\" at {}, {}{}", lines.size(), camera.name,
                                    to_text(Vec3(camera.world_from_camera[3])), view_text(camera),
                                    aspect));
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

/// 0 "first", 1 "second" ...
std::vector<std::string> numbered(const std::vector<std::string>& names)
{
    std::vector<std::string> lines;
    for (const std::string& name : names) {
        lines.push_back(fmt::format("{} \"{}\"", lines.size(), name));
    }
    return lines;
}

ordered_json camera_json(const CameraDesc& camera)
{
    ordered_json result{{"name", camera.name},
                        {"position", to_json(Vec3(camera.world_from_camera[3]))}};
    if (camera.projection == Projection::orthographic) {
        result["projection"] = "orthographic";
        result["vertical_extent"] = camera.vertical_extent;
    } else {
        result["projection"] = "perspective";
        result["vertical_fov_degrees"] = degrees(camera.vertical_fov);
    }
    if (camera.lens_radius > 0.0f) {
        result["lens_radius"] = camera.lens_radius;
        result["focus_distance"] = camera.focus_distance;
    }
    result["aspect_ratio"] =
        camera.aspect_ratio ? ordered_json(*camera.aspect_ratio) : ordered_json();
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
ordered_json array_of(const Items& items, Convert convert)
{
    ordered_json result = ordered_json::array();
    for (const auto& item : items) {
        result.push_back(convert(item));
    }
    return result;
}

}  // namespace

SceneReport make_report(const std::string& file, const io::LoadedScene& loaded)
{
    SceneReport report;
    report.file = file;
    report.facts = loaded.facts;
    report.cameras = loaded.cameras;
    report.warnings = loaded.warnings;
    report.instances = loaded.scene.instances.size();
    for (const LightDesc& light : loaded.scene.lights) {
        report.lights.push_back(std::visit(LightText{}, light));
    }
    for (const MaterialDesc& material : loaded.scene.materials) {
        report.materials.push_back(material.name);
        if (material.emission != Rgb(0.0f)) {
            report.emissive.push_back(
                fmt::format("\"{}\" emits {} nit", material.name, to_text(material.emission)));
        }
    }
    for (const TexelImage& image : loaded.scene.images) {
        report.texture_sizes.push_back(fmt::format("{}x{}", image.width, image.height));
    }
    if (loaded.cameras.empty()) {
        report.defaults.emplace_back("no camera: a render frames the whole scene");
    }
    if (!has_light(loaded.scene)) {
        report.defaults.emplace_back("no light: a render adds a soft sky");
    }
    return report;
}

std::string to_text(const SceneReport& report)
{
    const io::GltfFacts& facts = report.facts;
    Lines lines;
    lines.add("file", report.file);
    lines.add("glTF", facts.version);
    if (!facts.generator.empty()) {
        lines.add("generator", facts.generator);
    }
    if (!facts.copyright.empty()) {
        lines.add("copyright", facts.copyright);
    }
    lines.add_list("scenes", scene_lines(facts));
    lines.add("triangles",
              fmt::format("{} in meshes, {} in the scene ({} without area, {} emit)",
                          report.counts.triangles, report.counts.instanced_triangles,
                          report.counts.degenerate_triangles, report.counts.emissive_triangles));
    lines.add("instances",
              fmt::format("{} ({} nodes, {} meshes of {} primitives)", report.instances,
                          facts.nodes, facts.meshes, facts.primitives));
    if (report.bounds) {
        lines.add("bounds", fmt::format("{} to {} m", to_text(report.bounds->min),
                                        to_text(report.bounds->max)));
    }
    lines.add("materials", fmt::format("{}", facts.materials));
    lines.add_list("", report.emissive);
    lines.add("textures",
              fmt::format("{} of {} images{}{}", facts.textures, facts.images,
                          report.texture_sizes.empty() ? "" : ": ", summary(report.texture_sizes)));
    lines.add_list("cameras", camera_lines(report.cameras));
    lines.add_list("lights", report.lights);
    lines.add_list("extensions", extension_lines(facts.extensions));
    lines.add_list("variants", numbered(facts.variant_names));
    lines.add_list("animations", numbered(facts.animation_names));
    if (facts.skins > 0) {
        lines.add("skins", fmt::format("{}", facts.skins));
    }
    lines.add_list("warnings", report.warnings);
    lines.add_list("defaults", report.defaults);
    return lines.text();
}

ordered_json to_json(const SceneReport& report)
{
    const io::GltfFacts& facts = report.facts;
    const SceneCounts& counts = report.counts;
    ordered_json result{{"file", report.file},
                        {"gltf_version", facts.version},
                        {"generator", facts.generator},
                        {"copyright", facts.copyright},
                        {"scenes", facts.scene_names}};
    result["scene"] = facts.scene ? ordered_json(*facts.scene) : ordered_json();
    result["triangles"] = {{"in_meshes", counts.triangles},
                           {"in_scene", counts.instanced_triangles},
                           {"degenerate", counts.degenerate_triangles},
                           {"emissive", counts.emissive_triangles}};
    result["counts"] = {{"nodes", facts.nodes},           {"meshes", facts.meshes},
                        {"primitives", facts.primitives}, {"instances", report.instances},
                        {"materials", facts.materials},   {"textures", facts.textures},
                        {"images", facts.images},         {"skins", facts.skins},
                        {"animations", facts.animations}, {"punctual_lights", facts.lights},
                        {"cameras", facts.cameras}};
    result["bounds"] = report.bounds ? ordered_json{{"min", to_json(report.bounds->min)},
                                                    {"max", to_json(report.bounds->max)}}
                                     : ordered_json();
    result["variants"] = facts.variant_names;
    result["animations"] = facts.animation_names;
    result["materials"] = report.materials;
    result["emissive_materials"] = report.emissive;
    result["texture_sizes"] = report.texture_sizes;
    result["cameras"] = array_of(report.cameras, camera_json);
    result["lights"] = report.lights;
    result["extensions"] = array_of(facts.extensions, extension_json);
    result["warnings"] = report.warnings;
    result["defaults"] = report.defaults;
    return result;
}

}  // namespace bdpt::app
