#pragma once

// Only server.cpp and connection.cpp include this: Boost takes long to compile.

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/file_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket.hpp>

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "server/server.h"
#include "session/session.h"

namespace bdpt::view {

class Connection;
class Window;

/// State shared by all connections of a server.
struct ServerState {
    std::string page;
    std::optional<Access> access;
    Session* session = nullptr;  ///< set by `Server::start`
    std::string text{};          ///< last state sent to pages; empty: none yet
    std::array<std::shared_ptr<const Frame>, 2> frames{};  ///< last frame of each slot
    std::map<ClientId, std::weak_ptr<Window>> windows{};
    ClientId next_client = 1;
    std::list<Connection*> strangers{};  ///< have not shown the token yet, oldest first
    int clients = 0;                     ///< connections and windows that have
    bool takes_file = false;             ///< a page gives one at the moment
    bool is_closing = false;
};

/// An HTTP connection, until it ends or becomes a `Window`.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    Connection(boost::asio::ip::tcp::socket socket, ServerState& server);
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void read();
    /// Ends it, whatever it waits for.
    void close();

private:
    using Parser = boost::beast::http::request_parser<boost::beast::http::empty_body>;
    using Response = boost::beast::http::response<boost::beast::http::string_body>;

    void take(const boost::system::error_code& error);
    void serve();
    /// Counts it as a client; returns false if there are too many.
    [[nodiscard]] bool become_client();
    /// Counts it no longer.
    void leave();
    void save(const std::string& name);
    /// Takes the environment that a page gives.
    void take_environment(std::string_view query);
    void read_environment();
    void give_environment();
    /// Tells how a file was saved or taken.
    void answer(Download file);
    /// Returns what the session calls for that, on its thread.
    [[nodiscard]] std::function<void(Download)> answer_later();
    void open_window();
    void refuse(int status, const std::string& line);
    void send(Response response);
    [[nodiscard]] Response response(int status, const std::string& type) const;

    boost::beast::tcp_stream stream_;
    ServerState& server_;
    boost::beast::flat_buffer buffer_;
    std::optional<Parser> parser_;
    bool keeps_alive_ = false;  // as the request wants
    struct Upload;
    std::unique_ptr<Upload> upload_;  // a file that is being given
    enum class Standing : std::uint8_t { stranger, client, none };
    Standing standing_ = Standing::stranger;
    std::list<Connection*>::iterator place_;  // of a stranger
};

/// An open page: a web socket.
class Window : public std::enable_shared_from_this<Window> {
public:
    using Stream = boost::beast::websocket::stream<boost::beast::tcp_stream>;

    Window(boost::beast::tcp_stream stream, ServerState& server);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    void open(const boost::beast::http::request<boost::beast::http::empty_body>& request);
    /// Sends the server's current state.
    void tell();
    void show(const std::shared_ptr<const Frame>& frame);
    void answer(std::string text);
    void close();

private:
    void read();
    void write();
    void sent(const boost::system::error_code& error);

    Stream stream_;
    ServerState& server_;
    ClientId client_;
    boost::beast::flat_buffer buffer_;
    // Waiting to be sent.
    std::deque<std::string> answers_;
    bool has_news_ = false;  // the state
    std::array<std::shared_ptr<const Frame>, 2> frames_;
    // Being sent.
    bool is_writing_ = false;
    bool is_open_ = false;
    std::string text_;
    FrameHeader header_{};
    std::shared_ptr<const Frame> frame_;
};

}  // namespace bdpt::view
