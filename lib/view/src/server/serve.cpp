#include <bdpt/eval/page.h>
#include <bdpt/version.h>
#include <bdpt/view.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "server/server.h"
#include "session/session.h"
#include "state/view_state.h"

namespace bdpt::view {
namespace {

/// Stops the server before the session is destroyed, whose tasks it holds.
class Serving {
public:
    Serving(Server& server, Session& session) : server_(server) { server_.start(session); }
    ~Serving() { server_.stop(); }
    Serving(const Serving&) = delete;
    Serving& operator=(const Serving&) = delete;

private:
    Server& server_;
};

}  // namespace

std::string view_page()
{
    const nlohmann::ordered_json data{{"heat", eval::heat_text()}, {"version", BDPT_VERSION}};
    const std::string text = eval::script_safe(data.dump());
    return eval::fill_page(page_template(),
                           {{"style", page_style()}, {"data", text}, {"script", page_script()}});
}

void serve(const OptionList& options, const NetworkAddress& address, Console& console,
           const std::function<void(const PageAddress&)>& on_listening)
{
    const std::unique_ptr<Server> server = make_server(address);
    Session session(ViewWords(options), *server, console);
    const Serving serving(*server, session);
    on_listening(server->page_address());
    session.run();
}

}  // namespace bdpt::view
