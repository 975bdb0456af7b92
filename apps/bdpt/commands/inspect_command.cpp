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
#include "output/render_report.h"
#include "stage/prepared_scene.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

/// Options of `bdpt inspect`, as given.
struct InspectRequest {
    RenderRequest render{};  ///< options shared with `bdpt render`; the rest is unused
    PixelSample sample{};
    std::optional<std::filesystem::path> directions{};  ///< .png or .exr
    int vertex = 1;   ///< index of the vertex whose directions are shown
    int width = 512;  ///< width of images of directions [pixels]
};

constexpr int widest = 8192;

/// Parses "X,Y".
std::optional<std::pair<int, int>> parse_pixel(const std::string& text)
{
    constexpr std::size_t widest_image = 65535;
    const std::vector<std::string_view> parts = split(text, ',');
    const auto x = parts.size() == 2 ? parse_index(parts[0]) : std::nullopt;
    const auto y = parts.size() == 2 ? parse_index(parts[1]) : std::nullopt;
    return x && y && std::max(*x, *y) <= widest_image
               ? std::optional(std::pair(static_cast<int>(*x), static_cast<int>(*y)))
               : std::nullopt;
}

void add_what(OptionList& options, InspectRequest& arguments)
{
    options.section("What to inspect");
    PixelSample& sample = arguments.sample;
    Option& pixel = options.add(
        "--pixel", "X,Y", "The pixel, from the top left; 0,0 is the first", sample,
        parsed_by(
            [&sample](const std::string& text) {
                const auto place = parse_pixel(text);
                return place ? std::optional(PixelSample{
                                   .x = place->first, .y = place->second, .index = sample.index})
                             : std::nullopt;
            },
            "two whole numbers X,Y, like 640,360"));
    pixel.required = true;
    options.add("--sample", "I", "Index of its sample. Default: 0", sample.index,
                whole_number(0, (std::int64_t{1} << 32) - 2));
    options.add(
        "--spp", "N",
        "Samples per pixel of the render that has this sample: its random numbers depend on "
        "them. Default: 64",
        arguments.render.spp, whole_number(1, std::int64_t{1} << 31));
    options.add("-o,--output", "FILE",
                "Image of the directions at a vertex: .png, or .exr with the values",
                arguments.directions,
                file_named({".png", ".exr"}, "a file name that ends in .png or .exr"));
    options.add("--vertex", "K",
                "Vertex of the camera path for that image; 1 (default) is the first surface",
                arguments.vertex, whole_number(1, 4096));
    options.add("--width", "N",
                "Width of each sphere of directions in it, an even number [pixels]. Default: 512",
                arguments.width, whole_number(2, widest));
}

constexpr const char* inspect_footer = R"(Examples:
  bdpt inspect room.glb --pixel 640,360
  bdpt inspect room.glb --pixel 12,30 --size 64x64 --spp 16 --integrator bdpt --sample 7 --json
  bdpt inspect room.glb --pixel 640,360 -o directions.png

Prints one sample of a pixel: the vertices of its camera path and its light path, and the
contribution of each strategy (s, t), with its MIS weight and, for bdpt and lt, the shares of all
strategies that could have sampled the same path. -o draws the integrand at a vertex and the pdfs
that sample it: docs/inspect.md.

Exit codes: 0 done, 1 internal error, 2 wrong usage (also: no such pixel or vertex), 3 input not
found, 4 invalid input, 5 unsupported feature, 6 output cannot be written, 7 out of memory.)";

void add_inspect_options(OptionList& options, InspectRequest& request)
{
    RenderRequest& render = request.render;
    RenderOptions& render_options = render.arguments.options;
    add_scene_file(options, render);
    add_what(options, request);
    options.section("How to render");
    add_fields(options, render_options, std::array<std::string_view, 2>{"seed", "threads"});
    add_transport_options(options, render_options, render.only);
    add_fields(options, render_options,
               std::array<std::string_view, 3>{"env_sampling", "light_sampling", "light_samples"});
    add_size_option(options, render, "Image size");
    add_view_options(options, render);
    options.section("Output");
    add_json_option(options, render.arguments.printed,
                    "Print one JSON object on stdout instead of text");
}

void write_directions(const InspectRequest& arguments, const PreparedScene& stage,
                      const RenderOptions& options)
{
    const DirectionMaps maps = inspect_directions(
        stage.scene, stage.camera, options, arguments.sample, arguments.vertex, arguments.width);
    const std::filesystem::path file = written_file(*arguments.directions);
    io::ImageMetadata metadata;
    metadata.version = BDPT_VERSION;
    metadata.created = std::chrono::system_clock::now();
    if (find_type(*arguments.directions) == ImageType::png) {
        io::write_png(file, direction_sheet(maps, options.sampling.light_samples),
                      {.metadata = metadata});
        return;
    }
    static_cast<void>(
        io::write_exr(file, maps.product, direction_layers(maps), {.metadata = metadata}));
}

int run_inspect(const InspectRequest& arguments, const OptionList& given, const Words& /*words*/)
{
    const RenderArguments what = checked(arguments.render, given);
    if (arguments.width % 2 != 0) {
        given.reject_value("--width", "an even number");
    }
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
    options.sampling.samples = what.samples;
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

}  // namespace

void add_inspect_command(Program& program)
{
    add_command<InspectRequest>(program, "inspect", "Print the paths of one sample of a pixel",
                                inspect_footer, add_inspect_options, run_inspect);
}

}  // namespace bdpt::app
