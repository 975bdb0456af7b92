#include "commands/commands.h"

#include <signal.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "terminal/console.h"
#include "view/server/page.h"
#include "view/server/server.h"
#include "view/session.h"

namespace bdpt::app {
namespace {

/// Opens `url` in the desktop's browser; returns false on failure.
bool open_in_browser(const std::string& url)
{
    std::string program = "xdg-open";
    std::string address = url;
    const std::array<char*, 3> words{program.data(), address.data(), nullptr};
    pid_t child = 0;
    return ::posix_spawnp(&child, program.c_str(), nullptr, nullptr, words.data(), environ) == 0;
}

/// Stops the server before the session is destroyed, whose tasks it holds.
class Serving {
public:
    Serving(Server& server, Doors doors) : server_(server) { server_.start(std::move(doors)); }
    ~Serving() { server_.stop(); }
    Serving(const Serving&) = delete;
    Serving& operator=(const Serving&) = delete;

private:
    Server& server_;
};

}  // namespace

int run_view(const ViewArguments& arguments, const OptionList& options)
{
    TerminalConsole console(Format::text, arguments.stage.printed.verbosity);
    const std::unique_ptr<Server> made = make_server(arguments.listen, view_page());
    Server& server = *made;
    Session session(ViewWords(options), server, console);
    const Serving serving(
        server,
        {.join = [&](ClientId client) { session.join(client); },
         .leave = [&](ClientId client) { session.leave(client); },
         .ask = [&](ClientId client, const std::string& text) { session.ask(client, text); },
         .save =
             [&](const std::string& name, int slot, std::function<void(Download)> done) {
                 session.save(name, slot, std::move(done));
             },
         .stop = [&] { session.stop(); }});
    print_text(server.url() + "\n");
    std::fflush(stdout);
    if (arguments.opens_browser && !open_in_browser(server.url_once())) {
        console.warning("there is no xdg-open: open the address in a browser");
    }
    session.run();
    return 0;
}

}  // namespace bdpt::app
