#include "commands/commands.h"

#include <bdpt/default_lights.h>
#include <bdpt/error.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/scene.h>
#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "machine/machine_limits.h"
#include "options/groups/view_arguments.h"
#include "options/value_types.h"
#include "report/reports.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

/// Arguments of `bdpt info`.
struct InfoArguments {
    std::string file{};                         ///< empty: only the limits
    io::GltfOptions scene{};                    ///< selects the part of the file to describe
    std::optional<std::uint64_t> max_memory{};  ///< [bytes]
    bool limits = false;                        ///< print the limits for reading files
    bool json = false;
};

struct Limit {
    std::string_view name;
    std::uint64_t value = 0;
    std::string_view meaning;
};

/// Returns all limits: a new member of the struct does not compile until it is added here.
std::vector<Limit> list(const io::ReadLimits& limits)
{
    const auto& [file_bytes, buffer_bytes, json_bytes, json_depth, json_values, nodes, node_depth,
                 instances, mesh_bytes, triangles, image_side, image_bytes, texture_bytes,
                 volume_bytes, volume_seconds, compression_ratio, memory_bytes] = limits;
    return {
        {"file_bytes", file_bytes, "bytes of one file"},
        {"buffer_bytes", buffer_bytes, "bytes of all buffers of a scene"},
        {"json_bytes", json_bytes, "bytes of the JSON text, data URIs included"},
        {"json_depth", json_depth, "nested objects and arrays"},
        {"json_values", json_values, "objects, arrays, strings, numbers"},
        {"nodes", nodes, "nodes of a scene"},
        {"node_depth", node_depth, "nested nodes"},
        {"instances", instances, "meshes placed in a scene"},
        {"mesh_bytes", mesh_bytes, "bytes of vertices, key frames and instances, decoded"},
        {"triangles", triangles, "triangles, each mesh once"},
        {"image_side", static_cast<std::uint64_t>(image_side), "pixels per side of an image"},
        {"image_bytes", image_bytes, "bytes of one image, decoded"},
        {"texture_bytes", texture_bytes, "bytes of all images, decoded"},
        {"volume_bytes", volume_bytes, "bytes of the densities of a volume"},
        {"volume_seconds", volume_seconds, "CPU seconds to read a volume"},
        {"compression_ratio", compression_ratio, "decoded over encoded size of compressed meshes"},
        {"memory_bytes", memory_bytes, "bytes of a scene in memory, as estimated"}};
}

/// Returns the limits of files, one line each: name, value, subject.
std::string limits_text(const io::ReadLimits& limits)
{
    std::string text;
    for (const Limit& limit : list(limits)) {
        text += fmt::format("{:<18}{:>12}  {}\n", limit.name, limit.value, limit.meaning);
    }
    return text;
}

/// Returns the limits as names and numbers.
nlohmann::ordered_json limits_json(const io::ReadLimits& limits)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const Limit& limit : list(limits)) {
        json[std::string(limit.name)] = limit.value;
    }
    return json;
}

/// Adds the facts that need a built scene, or why there is none.
void complete(SceneReport& report, SceneDesc desc)
{
    const bool empty = !has_surface(desc);
    try {
        const Scene scene(std::move(desc));
        report.knowledge = Knowledge::built;
        report.counts = scene.counts();
        if (empty) {
            report.problem = {.code = ErrorCode::invalid_input,
                              .message =
                                  "no triangles and no light with a radius: there is "
                                  "nothing to render"};
            return;
        }
        report.bounds = scene.bounds();
        const DefaultLights missing = missing_lights(scene, metered_view(scene));
        report.defaults.sky = missing != DefaultLights::none;
        report.defaults.lamp = missing == DefaultLights::sky_and_lamp;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::invalid_input) {
            throw;
        }
        report.problem = {.code = error.code(), .message = error.what()};
    }
}

/// Tests whether the file is at fault, not the user's selection.
bool is_about_file(const Error& error, const io::GltfOptions& scene)
{
    const bool chosen = scene.scene || scene.variant || scene.animation;
    return error.code() == ErrorCode::invalid_input || error.code() == ErrorCode::unsupported ||
           (error.code() == ErrorCode::not_found && !chosen);
}

/// Returns the facts of a file that cannot be loaded. Throws `failure` if there are none.
SceneReport report_facts(const std::string& file, const io::ReadLimits& limits,
                         const Error& failure)
{
    SceneReport report;
    report.file = file;
    report.problem = {.code = failure.code(), .message = failure.what()};
    try {
        report.facts = io::read_gltf_facts(file, limits);
    } catch (const Error&) {
        throw failure;
    }
    return report;
}

SceneReport read_report(const InfoArguments& arguments, const io::GltfOptions& options)
{
    try {
        io::LoadedScene loaded = io::load_gltf(arguments.file, options);
        SceneReport report = make_report(arguments.file, loaded);
        complete(report, std::move(loaded.scene));
        return report;
    } catch (const Error& error) {
        if (options.strict || !is_about_file(error, arguments.scene)) {
            throw;
        }
        return report_facts(arguments.file, options.limits, error);
    }
}

constexpr const char* info_footer = R"(Examples:
  bdpt info scene.gltf
  bdpt info scene.glb --json
  bdpt info --limits

A file that can be read but not rendered is described too, with the reason.

Exit codes: as those of bdpt render, but without --strict 0 for a file that can be read and not
rendered.)";

void add_info_options(OptionList& options, InfoArguments& arguments)
{
    options.add("file", "FILE", "The scene: .gltf or .glb; - is the standard input", arguments.file,
                any_text());
    options.section("Scene");
    add_scene_options(options, arguments.scene, arguments.max_memory);
    options.section("");
    options.add_flag("--limits", "Print the limits of what a file may contain", arguments.limits);
    options.add_flag("--json", "Print one JSON object instead of text", arguments.json);
}

int run_info(const InfoArguments& arguments, const OptionList& given, const Words& /*words*/)
{
    if (!given.given("file") && !arguments.limits) {
        throw OptionError("file is required");
    }
    const io::MemoryLimit memory = scene_memory_limit(arguments.max_memory);
    io::GltfOptions options = arguments.scene;
    options.limits.memory_bytes = memory.bytes;
    options.memory = std::make_shared<io::MemoryBudget>(memory);
    std::string text;
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    if (!arguments.file.empty()) {
        const SceneReport report = read_report(arguments, options);
        text = info_text(report);
        json = info_json(report);
    }
    if (arguments.limits) {
        text += limits_text(options.limits);
        json["limits"] = limits_json(options.limits);
    }
    if (arguments.json) {
        text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    }
    print_text(text);
    return 0;
}

}  // namespace

void add_info_command(Program& program)
{
    add_command<InfoArguments>(program, "info", "Print what a scene contains", info_footer,
                               add_info_options, run_info);
}

}  // namespace bdpt::app
