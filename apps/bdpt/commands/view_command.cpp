#include "commands/commands.h"

#include <bdpt/view.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>

#include "options/option_list.h"
#include "options/render_arguments.h"
#include "options/value_types.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

/// Options of `bdpt view`, as given.
struct ViewRequest {
    RenderRequest render{};  ///< options shared with `bdpt render`; the rest is unused
    NetworkAddress listen{.host = "127.0.0.1", .port = "0"};  ///< port 0: any free one
    bool opens_browser = false;
};

/// Options of `bdpt render` about its files, its processes and its sequences.
constexpr std::array<std::string_view, 26> not_for_view{
    "others",       "--output",         "--samples", "--time",    "--stats", "--save-rates",
    "--strategies", "--strategy-depth", "--part",    "--restart", "--plan",  "--task",
    "--display",    "--save-job",       "--frames",  "--fps",     "--orbit", "--turn",
    "--cameras",    "--same-noise",     "--json",    "--aov",     "--half",  "--float",
    "--tiled",      "--full-paths"};

constexpr const char* view_footer = R"(Examples:
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

constexpr const char* view_short_footer = R"(Examples:
  bdpt view model.glb
  bdpt view model.glb --env studio --background white

"bdpt view --help-all" has all options and the exit codes.)";

void add_view_options(OptionList& options, ViewRequest& request)
{
    add_render_options(options, request.render);
    std::deque<Option>& all = options.all();
    std::erase_if(all, [](const Option& option) { return is_among(not_for_view, option.name()); });
    for (Option& option : all) {
        option.uses = {.stated_in = option.uses.stated_in};
        if (option.name() == "--spp") {
            option.help = "Samples per pixel of the finished image. Default: " +
                          std::to_string(view::view_samples);
        } else if (option.name() == "file") {
            option.help = "The scene: .gltf or .glb, or a job: .json";
        } else if (option.name() == "--noise") {
            option.help = "Stop at this noise, like 2%";
        }
    }
    options.section("Server", {.stated_in = StatedIn::command_line});
    options.add("--listen", "HOST[:PORT]|PORT",
                "Address to listen on. Default: 127.0.0.1 (this machine only) and any free port",
                request.listen,
                parsed_by(parse_listen_address, "HOST, HOST:PORT or PORT, like 127.0.0.1:8080"));
    options.add_flag("--open", "Show the page in the browser (xdg-open)", request.opens_browser);
}

/// Stores the picture's options of the job in `file` into `options`, those of `bdpt view`, except
/// options that were already given. Other options, such as output names, are checked and ignored.
/// Throws `Error` like `load_job`.
void load_viewed_job(const std::filesystem::path& file, OptionList& options)
{
    RenderOptionList render;
    render.list.take_texts(options);
    load_job(file, render.list);
    options.take_texts(render.list);
    options.store_given();
}

/// Opens `url` in the desktop's browser; returns false on failure.
bool open_in_browser(const std::string& url)
{
    std::string program = "xdg-open";
    std::string address = url;
    const std::array<char*, 3> words{program.data(), address.data(), nullptr};
    pid_t child = 0;
    return ::posix_spawnp(&child, program.c_str(), nullptr, nullptr, words.data(), environ) == 0;
}

/// Returns the exit code: 0 after SIGINT.
int run_view(ViewRequest& request, OptionList& options, const Words& /*words*/)
{
    if (const std::filesystem::path file = request.render.arguments.file; is_job(file)) {
        load_viewed_job(file, options);
    }
    const RenderArguments shown = checked(request.render, options);
    if (shown.file == "-" || shown.environment == "-") {
        throw OptionError("-: the standard input cannot be read again; name a file");
    }
    TerminalConsole console(Format::text, shown.printed.verbosity);
    view::serve(options, request.listen, console, [&](const view::PageAddress& page) {
        print_text(page.url + "\n");
        std::fflush(stdout);
        if (request.opens_browser && !open_in_browser(page.url_once)) {
            console.warning("there is no xdg-open: open the address in a browser");
        }
    });
    return 0;
}

}  // namespace

std::optional<NetworkAddress> parse_listen_address(const std::string& typed)
{
    const bool is_port = !typed.empty() && parse_index(typed).has_value();
    return parse_address(is_port ? "127.0.0.1:" + typed : typed, "0");
}

void add_view_command(Program& program)
{
    Command& command = add_command<ViewRequest>(
        program, "view", "Preview a scene in the browser, to choose view, light and look",
        view_footer, add_view_options, run_view);
    command.essentials = {{"file"},         {"--spp"},    {"--size"},     {"--camera"},
                          {"--view"},       {"--env"},    {"--exposure"}, {"--integrator"},
                          {"--background"}, {"--listen"}, {"--open"}};
    command.short_footer = view_short_footer;
}

}  // namespace bdpt::app
