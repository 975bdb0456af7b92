#include "info_command.h"

#include <bdpt/framing.h>
#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "default_lights.h"
#include "scene_report.h"

namespace bdpt::app {
namespace {

constexpr const char* footer = R"(Examples:
  bdpt info scene.gltf
  bdpt info scene.glb --json

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
    command.add_option("file", arguments.file, "The scene: .gltf or .glb")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--scene", arguments.scene, "Scene of the file; the default one if not given")
        ->type_name("NAME|INDEX");
    command.add_flag("--json", arguments.json, "One JSON object instead of text");
    command.footer(footer);
}

int run_info(const InfoArguments& arguments)
{
    io::GltfOptions options;
    options.scene = arguments.scene;
    io::LoadedScene loaded = io::load_gltf(arguments.file, options);
    SceneReport report = make_report(arguments.file, loaded);
    complete(report, std::move(loaded.scene));
    using nlohmann::ordered_json;
    const std::string text =
        arguments.json
            ? to_json(report).dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n"
            : to_text(report);
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() ||
        std::fflush(stdout) != 0) {
        throw Error(ErrorCode::output, "stdout: cannot write the report");
    }
    return 0;
}

}  // namespace bdpt::app
