#include "options/view_arguments.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "options/arguments.h"
#include "options/job_file.h"
#include "options/values/pipes.h"
#include "options/values/value_types.h"

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
    RenderRequest request;
    OptionList render;
    add_render_options(render, request);
    for (Option& option : render.all()) {
        if (const Option* given = options.find(option.name())) {
            option.texts = given->texts;
        }
    }
    load_job(file, render);
    for (Option& option : options.all()) {
        if (const Option* loaded = render.find(option.name())) {
            option.texts = loaded->texts;
        }
    }
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

}  // namespace bdpt::app
