#include "commands/commands.h"

#include <bdpt/io/write_image.h>
#include <bdpt/render.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "options/groups/transport_arguments.h"
#include "options/output_files.h"
#include "report/inspect_report.h"
#include "stage/prepared_scene.h"
#include "stage/render_preparation.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

void write_directions(const InspectArguments& arguments, const PreparedScene& stage,
                      const RenderOptions& options)
{
    const DirectionMaps maps = inspect_directions(
        stage.scene, stage.camera, options, arguments.sample, arguments.vertex, arguments.width);
    const std::filesystem::path file = written_file(*arguments.directions);
    io::ImageMetadata metadata;
    metadata.version = BDPT_VERSION;
    metadata.created = std::chrono::system_clock::now();
    if (find_type(*arguments.directions) == ImageType::png) {
        io::PngOptions png;
        png.metadata = metadata;
        io::write_png(file, direction_sheet(maps, options.sampling.light_samples), png);
        return;
    }
    io::ExrOptions exr;
    exr.metadata = metadata;
    static_cast<void>(io::write_exr(file, maps.product, direction_layers(maps), exr));
}

}  // namespace

int run_inspect(const InspectArguments& arguments)
{
    const RenderArguments& what = arguments.stage;
    const auto check_directions = [&](const FileSet& inputs) {
        if (arguments.directions) {
            check_outputs(std::array{*arguments.directions}, inputs);
        }
    };
    check_directions(input_files(what));
    // stdout has the report alone.
    TerminalConsole console(Format::text, what.printed.verbosity);
    const PreparedScene stage = prepare_scene(what);
    check_directions(input_files(what, stage));
    tell_findings(console, stage);
    RenderOptions options = what.options;
    options.film.width = stage.size.width;
    options.film.height = stage.size.height;
    const bool chosen = options.integrator == IntegratorKind::automatic;
    options = chosen_options(stage.scene, stage.camera, options);
    const InspectedSample sample =
        inspect_sample(stage.scene, stage.camera, options, arguments.sample);
    if (arguments.directions) {
        write_directions(arguments, stage, options);
    }
    const DVec3 origin = stage.scene.description().origin;
    if (what.printed.format == Format::json) {
        nlohmann::ordered_json json = inspect_json(sample, arguments.sample, origin);
        json["settings"] = transport_json(options);
        print_text(json.dump(2) + "\n");
    } else {
        print_text(fmt::format("{}, camera {}, {}\n{}", what.file.string(), stage.camera.name,
                               integrator_text(options, chosen),
                               inspect_text(sample, arguments.sample, origin)));
    }
    return 0;
}

}  // namespace bdpt::app
