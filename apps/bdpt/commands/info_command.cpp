#include "commands/info_command.h"

#include <bdpt/default_lights.h>
#include <bdpt/error.h>
#include <bdpt/framing.h>
#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "report/limits_text.h"
#include "report/scene_report.h"

namespace bdpt::app {
namespace {

constexpr const char* footer = R"(Examples:
  bdpt info scene.gltf
  bdpt info scene.glb --json
  bdpt info --limits

Exit codes: as those of bdpt render.)";

/// Adds what only a built scene knows.
void complete(SceneReport& report, SceneDesc desc)
{
    const bool dark = !has_light(desc);
    const bool empty = !has_surface(desc);
    const Scene scene(std::move(desc));
    report.counts = scene.counts();
    if (empty) {
        report.defaults.emplace_back(
            "no triangles and no light with a radius: there is nothing to render");
        return;
    }
    report.bounds = scene.bounds();
    constexpr float aspect = 16.0f / 9.0f;
    if (dark && frame_scene(scene, aspect).enclosed) {
        report.defaults.emplace_back("a closed room without light: a render adds a lamp");
    }
}

}  // namespace

void add_info_options(CLI::App& command, InfoArguments& arguments)
{
    command.add_option("file", arguments.file, "The scene: .gltf or .glb")->type_name("FILE");
    add_scene_options(command, arguments.scene, "What to look at");
    command.add_flag("--limits", arguments.limits, "Print what a file may hold at most");
    command.add_flag("--json", arguments.json, "One JSON object instead of text");
    command.footer(footer);
}

int run_info(const InfoArguments& arguments)
{
    using nlohmann::ordered_json;
    const io::GltfOptions options = to_gltf_options(arguments.scene);
    std::string text;
    ordered_json json = ordered_json::object();
    if (!arguments.file.empty()) {
        io::LoadedScene loaded = io::load_gltf(arguments.file, options);
        SceneReport report = make_report(arguments.file, loaded);
        complete(report, std::move(loaded.scene));
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
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() ||
        std::fflush(stdout) != 0) {
        throw Error(ErrorCode::output, "stdout: cannot write the report");
    }
    return 0;
}

}  // namespace bdpt::app
