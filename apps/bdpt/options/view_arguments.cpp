#include "options/view_arguments.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "options/groups/film_arguments.h"
#include "options/job_file.h"
#include "options/output_files.h"
#include "options/value_types.h"

namespace bdpt::app {

namespace {

/// Options of `bdpt render` about its files, its processes and its sequences.
constexpr std::array<std::string_view, 26> not_for_view{
    "others",       "--output",         "--samples", "--time",    "--stats", "--save-rates",
    "--strategies", "--strategy-depth", "--part",    "--restart", "--plan",  "--task",
    "--display",    "--save-job",       "--frames",  "--fps",     "--orbit", "--turn",
    "--cameras",    "--same-noise",     "--json",    "--aov",     "--half",  "--float",
    "--tiled",      "--full-paths"};

bool is_for_view(const Option& option)
{
    return std::find(not_for_view.begin(), not_for_view.end(), option.name()) == not_for_view.end();
}

}  // namespace

const char* const view_footer = R"(Examples:
  bdpt view model.glb
  bdpt view model.glb --env studio --background white
  bdpt view room.glb --integrator bdpt --size 960x540
  bdpt view room.glb --listen 127.0.0.1:8080
  bdpt view room.json                          (a job that the page saved)

Prints the address of a page that shows the render in progress: drag to orbit, click to inspect a
pixel; docs/view.md has the rest. The scene is reloaded when its files change. The address contains
a secret; requests without it are refused. For a remote server, use an ssh tunnel:
ssh -L 8080:127.0.0.1:8080 SERVER. Ctrl-C ends it.

Exit codes: 0 done (Ctrl-C), 1 internal error, 2 wrong usage, 3 input not found, 4 invalid input,
5 unsupported feature, 6 cannot listen there, 7 out of memory or threads.)";

const char* const view_short_footer = R"(Examples:
  bdpt view model.glb
  bdpt view model.glb --env studio --background white

"bdpt view --help-all" has all options and the exit codes.)";

std::optional<DisplayAddress> parse_listen_address(const std::string& typed)
{
    const bool is_port = !typed.empty() && parse_index(typed).has_value();
    const std::string text = is_port ? "127.0.0.1:" + typed : typed;
    const std::size_t host_end = text.starts_with('[') ? text.find(']') : 0;
    const std::size_t colon = text.find(':', host_end == std::string::npos ? 0 : host_end);
    const bool has_port = colon != std::string::npos && text.substr(colon + 1) != "0";
    if (has_port) {
        return parse_address(text);
    }
    std::string host = text.substr(0, colon);
    if (host.empty() && colon != std::string::npos) {
        host = "localhost";
    }
    std::optional<DisplayAddress> address = parse_address(host);
    if (address) {
        address->port = "0";
    }
    return address;
}

void add_view_command_options(OptionList& options, ViewRequest& request)
{
    add_render_options(options, request.render);
    std::deque<Option>& all = options.all();
    all.erase(std::remove_if(all.begin(), all.end(),
                             [](const Option& option) { return !is_for_view(option); }),
              all.end());
    for (Option& option : all) {
        option.uses = {.stated_in = option.uses.stated_in};
        if (option.name() == "--spp") {
            option.help =
                "Samples per pixel of the finished image. Default: " + std::to_string(view_samples);
        } else if (option.name() == "file") {
            option.help = "The scene: .gltf or .glb, or a job: .json";
        } else if (option.name() == "--noise") {
            option.help = "Stop at this noise, like 2%";
        }
    }
    options.section("Server", {.stated_in = StatedIn::command_line});
    options.add("--listen", "HOST[:PORT]|PORT",
                "Address to listen on. Default: 127.0.0.1 (this machine only) and any free port",
                request.arguments.listen,
                parsed_by(parse_listen_address, "HOST, HOST:PORT or PORT, like 127.0.0.1:8080"));
    options.add_flag("--open", "Show the page in the browser (xdg-open)",
                     request.arguments.opens_browser);
}

void load_viewed_job(const std::filesystem::path& file, OptionList& options)
{
    const auto copy_texts = [](const OptionList& from, OptionList& to) {
        for (Option& option : to.all()) {
            if (const Option* same = from.find(option.name())) {
                option.texts = same->texts;
            }
        }
    };
    RenderOptionList render;
    copy_texts(options, render.list);
    load_job(file, render.list);
    copy_texts(render.list, options);
    options.store_given();
}

ViewArguments checked(const ViewRequest& request, const OptionList& options)
{
    ViewArguments result = request.arguments;
    result.stage = checked(request.render, options);
    for (const std::string& file :
         {result.stage.file.string(), result.stage.environment.value_or("")}) {
        if (file == "-") {
            throw OptionError("-: the standard input cannot be read again; name a file");
        }
    }
    return result;
}

namespace {

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
