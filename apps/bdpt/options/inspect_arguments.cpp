#include "options/inspect_arguments.h"

#include <CLI/CLI.hpp>

#include "options/arguments.h"
#include "options/values/output_files.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

constexpr const char* inspect_examples = R"(Examples:
  bdpt inspect room.glb --pixel 640,360
  bdpt inspect room.glb --pixel 12,30 --size 64x64 --integrator bdpt --sample 7 --json
  bdpt inspect room.glb --pixel 640,360 -o directions.png

Tells what one sample of a pixel does: the vertices of its camera path and of its light path, and
what each strategy (s, t) brings, with its weight and, of bdpt and lt, the shares of all strategies
that could have made the same path. -o draws what is to be sampled at a vertex, and by what
densities: docs/inspect.md.

Exit codes: 0 done, 1 internal error, 2 wrong usage (also: no such pixel or vertex), 3 input not
found, 4 invalid input, 5 unsupported feature, 6 output cannot be written, 7 out of memory.)";

constexpr int widest = 8192;

void add_what(CLI::App& command, InspectWords& words)
{
    const auto group = "What to inspect";
    command.add_option("--pixel", words.pixel, "The pixel, from the top left; 0,0 is the first")
        ->required()
        ->type_name("X,Y")
        ->group(group);
    command.add_option("--sample", words.sample, "Index of its sample. Default: 0")
        ->check(whole_number(0, (std::int64_t{1} << 32) - 2))
        ->type_name("I")
        ->group(group);
    command
        .add_option("-o,--output", words.directions,
                    "Image of the directions at a vertex: .png, or .exr with the numbers")
        ->type_name("FILE")
        ->group(group);
    command
        .add_option("--vertex", words.vertex,
                    "Vertex of the camera path for that image; 1 (default) is the first surface")
        ->check(whole_number(1, 4096))
        ->type_name("K")
        ->group(group);
    command
        .add_option("--width", words.width,
                    "Width of each sphere of directions in it [pixels]. Default: 512")
        ->check(whole_number(2, widest))
        ->type_name("N")
        ->group(group);
}

}  // namespace

void add_inspect_options(CLI::App& command, InspectWords& words)
{
    command
        .add_option("file", words.render.file, "The scene: .gltf or .glb; - is the standard input")
        ->required()
        ->type_name("FILE");
    add_what(command, words);
    add_seed_and_threads(command, words.render, "How to render");
    add_transport_options(command, words.render.transport);
    command.add_option("--size", words.render.size, "Image size")
        ->type_name("WxH")
        ->group("How to render");
    add_view_options(command, words.render);
    command
        .add_flag("--json", words.render.json, "Print one JSON object on stdout instead of text")
        ->group("Output");
    command.footer(inspect_examples);
}

InspectArguments understand(const InspectWords& words)
{
    InspectArguments result{.stage = understand(words.render), .sample = {}};
    const std::size_t comma = words.pixel.find(',');
    const auto x = parse_index(words.pixel.substr(0, comma));
    const auto y =
        comma == std::string::npos ? std::nullopt : parse_index(words.pixel.substr(comma + 1));
    constexpr std::size_t widest_image = 65535;
    if (!x || !y || *x > widest_image || *y > widest_image) {
        reject("--pixel", words.pixel, "two whole numbers X,Y, like 640,360");
    }
    result.sample = {.x = static_cast<int>(*x), .y = static_cast<int>(*y), .index = words.sample};
    if (words.width % 2 != 0) {
        reject("--width", std::to_string(words.width), "an even number");
    }
    if (words.directions && !type_of(*words.directions)) {
        reject("--output", *words.directions, "a file that is named .png or .exr");
    }
    if (words.directions) {
        result.directions = *words.directions;
    }
    result.vertex = words.vertex;
    result.width = words.width;
    return result;
}

}  // namespace bdpt::app
