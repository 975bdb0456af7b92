#include "server/server.h"

#include <bdpt/error.h>
#include <bdpt/eval/page.h>
#include <bdpt/version.h>
#include <bdpt/view.h>
#include <fmt/core.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "server/connection.h"
#include "session/session.h"
#include "state/view_state.h"

namespace bdpt::view {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

constexpr std::size_t max_strangers = 64;

/// Adds brackets to hosts with colons.
std::string host_text(const std::string& host)
{
    return host.find(':') != std::string::npos ? "[" + host + "]" : host;
}

/// The server of `bdpt view`: the page, a web socket for each window, files. It runs on one thread
/// and never waits for a slow reader: each window has one picture in flight, and newer ones replace
/// the waiting one. What an audience does is thread-safe.
class Server final : public Audience {
public:
    /// Starts to listen. Throws `Error` (output) if that fails.
    explicit Server(const NetworkAddress& address)
        : signals_(context_),
          acceptor_(context_),
          pause_(context_),
          patience_(context_),
          token_(random_token()),
          ticket_(random_token())
    {
        state_.page = view_page();
        state_.access.emplace(token_, ticket_, address.host);
        try {
            tcp::resolver resolver(context_);
            const auto found = resolver.resolve(address.host, address.port);
            const tcp::endpoint endpoint = found.begin()->endpoint();
            acceptor_.open(endpoint.protocol());
            acceptor_.set_option(tcp::acceptor::reuse_address(true));
            acceptor_.bind(endpoint);
            acceptor_.listen();
        } catch (const boost::system::system_error& error) {
            throw Error(ErrorCode::output,
                        fmt::format("--listen {}:{}: cannot listen there: {}",
                                    host_text(address.host), address.port, error.code().message()));
        }
        site_ = fmt::format("http://{}:{}/", host_text(address.host),
                            acceptor_.local_endpoint().port());
    }

    ~Server() override { stop(); }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    [[nodiscard]] PageAddress page_address() const
    {
        return {.url = site_ + token_ + "/", .url_once = site_ + ticket_};
    }

    /// Serves what `session` renders, on a thread of its own, until `stop()`. SIGINT, SIGTERM and
    /// SIGHUP stop the session; a second one ends the process.
    void start(Session& session)
    {
        state_.session = &session;
        for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
            struct sigaction action {};
            ::sigaction(number, nullptr, &action);
            if (action.sa_handler != SIG_IGN) {  // nohup ignores signals
                signals_.add(number);
            }
        }
        wait_for_signal();
        accept();
        thread_ = std::thread([this] { context_.run(); });
    }

    void stop()
    {
        asio::post(context_, [this] {
            state_.is_closing = true;
            context_.stop();
        });
        if (thread_.joinable()) {
            thread_.join();
        }
    }

    void tell(std::string state) override
    {
        asio::post(context_, [this, state = std::move(state)]() mutable {
            state_.text = std::move(state);
            for_all([](Window& window) { window.tell(); });
        });
    }

    void show(std::shared_ptr<const Frame> frame) override
    {
        asio::post(context_, [this, frame = std::move(frame)] {
            state_.frames.at(frame->slot) = frame;
            for_all([&](Window& window) { window.show(frame); });
        });
    }

    void answer(ClientId client, std::string text) override
    {
        asio::post(context_, [this, client, text = std::move(text)]() mutable {
            const auto found = state_.windows.find(client);
            const auto window = found != state_.windows.end() ? found->second.lock() : nullptr;
            if (window) {
                window->answer(std::move(text));
            }
        });
    }

private:
    template <typename Work>
    void for_all(const Work& work)
    {
        for (const auto& [client, kept] : state_.windows) {
            if (const std::shared_ptr<Window> window = kept.lock()) {
                work(*window);
            }
        }
    }

    void wait_for_signal()
    {
        signals_.async_wait([this](const error_code& error, int number) {
            if (error) {
                return;
            }
            if (signal_.exchange(number) != 0) {
                ::_exit(128 + number);
            }
            state_.session->stop();
            end_soon();
            wait_for_signal();
        });
    }

    /// Ends the process if it has not ended in a moment: nothing is worth waiting for, such as a
    /// large scene that is still being loaded.
    void end_soon()
    {
        patience_.expires_after(std::chrono::milliseconds(500));
        patience_.async_wait([](const error_code& error) {
            if (!error) {
                ::_exit(0);
            }
        });
    }

    void accept()
    {
        acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
            if (error == asio::error::operation_aborted) {
                return;
            }
            if (error) {
                // Out of file descriptors: wait for free ones.
                pause_.expires_after(std::chrono::milliseconds(100));
                pause_.async_wait([this](const error_code& /*error*/) { accept(); });
                return;
            }
            // The oldest stranger goes, so that a client, who speaks at once, always gets in.
            if (state_.strangers.size() >= max_strangers) {
                state_.strangers.front()->close();
            }
            std::make_shared<Connection>(std::move(socket), state_)->read();
            accept();
        });
    }

    // First: connections, owned by the context, use it while they are destroyed.
    ServerState state_;
    asio::io_context context_{1};
    asio::signal_set signals_;
    tcp::acceptor acceptor_;
    asio::steady_timer pause_;
    asio::steady_timer patience_;
    std::string token_;
    std::string ticket_;
    std::string site_;
    std::atomic<int> signal_{0};
    std::thread thread_;
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
    Server server(address);
    Session session(ViewWords(options), server, console);
    // Stops the server before the session is destroyed, whose tasks it holds.
    const struct Serving {
        Server& server;
        ~Serving() { server.stop(); }
    } until_the_end{server};
    server.start(session);
    on_listening(server.page_address());
    session.run();
}

}  // namespace bdpt::view
