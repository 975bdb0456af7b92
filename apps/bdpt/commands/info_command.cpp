#include "commands/info_command.h"

#include <bdpt/default_lights.h>
#include <bdpt/error.h>
#include <bdpt/framing.h>
#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "report/limits_text.h"
#include "report/scene_report.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

constexpr const char* info_examples = R"(Examples:
  bdpt info scene.gltf
  bdpt info scene.glb --json
  bdpt info --limits

A file that can be read but not rendered is described too, with the reason.

Exit codes: as those of bdpt render, but 0 for a file that can be read and not rendered.)";

/// Adds what only a built scene knows, or why there is none.
void complete(SceneReport& report, SceneDesc desc)
{
    const bool dark = !has_light(desc);
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
        constexpr float aspect = 16.0f / 9.0f;
        report.defaults.lamp = dark && frame_scene(scene, aspect).enclosed;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::invalid_input) {
            throw;
        }
        report.problem = {.code = error.code(), .message = error.what()};
    }
}

/// Is it the file that is at fault, not what the user wants of it?
bool is_about_file(const Error& error, const SceneWords& words)
{
    const bool chosen = words.scene || words.variant || words.animation;
    return error.code() == ErrorCode::invalid_input || error.code() == ErrorCode::unsupported ||
           (error.code() == ErrorCode::not_found && !chosen);
}

/// What a file that cannot be loaded says about itself. Throws `failure` if that is nothing.
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

SceneReport report_of(const InfoArguments& arguments, const io::GltfOptions& options)
{
    try {
        io::LoadedScene loaded = io::load_gltf(arguments.file, options);
        SceneReport report = make_report(arguments.file, loaded);
        complete(report, std::move(loaded.scene));
        return report;
    } catch (const Error& error) {
        if (!is_about_file(error, arguments.scene)) {
            throw;
        }
        return report_facts(arguments.file, options.limits, error);
    }
}

}  // namespace

void add_info_options(CLI::App& command, InfoArguments& arguments)
{
    command.add_option("file", arguments.file, "The scene: .gltf or .glb; - is the standard input")
        ->type_name("FILE");
    add_scene_options(command, arguments.scene, "Scene");
    command.add_flag("--limits", arguments.limits, "Print the limits of what a file may contain");
    command.add_flag("--json", arguments.json, "Print one JSON object instead of text");
    command.footer(info_examples);
}

int run_info(const InfoArguments& arguments)
{
    using nlohmann::ordered_json;
    io::GltfOptions options = to_gltf_options(arguments.scene);
    options.memory = std::make_shared<io::MemoryBudget>(memory_limit(arguments.scene));
    std::string text;
    ordered_json json = ordered_json::object();
    if (!arguments.file.empty()) {
        const SceneReport report = report_of(arguments, options);
        text = to_text(report);
        json = to_json(report);
    } else if (!arguments.limits) {
        throw Error(ErrorCode::usage, "file is required; see \"bdpt info --help\"");
    }
    if (arguments.limits) {
        text += limits_text(options.limits);
        json["limits"] = limits_json(options.limits);
    }
    if (arguments.json) {
        text = json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
    }
    print_text(text);
    return 0;
}

}  // namespace bdpt::app
