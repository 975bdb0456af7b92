#include "options/inspect_arguments.h"

#include <array>
#include <utility>

#include "options/arguments.h"
#include "options/groups/render_fields.h"
#include "options/values/value_types.h"

namespace bdpt::app {
namespace {

constexpr int widest = 8192;

/// Parses "X,Y".
std::optional<std::pair<int, int>> parse_pixel(const std::string& text)
{
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) {
        return std::nullopt;
    }
    const auto x = parse_index(std::string_view(text).substr(0, comma));
    const auto y = parse_index(std::string_view(text).substr(comma + 1));
    constexpr std::size_t widest_image = 65535;
    if (!x || !y || *x > widest_image || *y > widest_image) {
        return std::nullopt;
    }
    return std::pair(static_cast<int>(*x), static_cast<int>(*y));
}

void add_what(OptionList& options, InspectArguments& arguments)
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

}  // namespace

const char* const inspect_footer = R"(Examples:
  bdpt inspect room.glb --pixel 640,360
  bdpt inspect room.glb --pixel 12,30 --size 64x64 --integrator bdpt --sample 7 --json
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
    add_what(options, request.arguments);
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

InspectArguments checked(const InspectRequest& request, const OptionList& options)
{
    InspectArguments result = request.arguments;
    result.stage = checked(request.render, options);
    if (result.width % 2 != 0) {
        options.reject_value("--width", "an even number");
    }
    return result;
}

}  // namespace bdpt::app
