#include "server/connection.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <chrono>
#include <utility>

namespace bdpt::view {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using boost::system::error_code;

namespace {

constexpr std::chrono::seconds patience{10};  // with silent clients
constexpr std::uint32_t max_header_bytes = 8192;
constexpr std::size_t max_message_bytes = 65536;
constexpr std::size_t max_waiting_answers = 256;  // per window
constexpr int max_clients = 64;

std::string_view to_view(boost::beast::string_view text)
{
    return {text.data(), text.size()};
}

/// Parses the N of the query "slot=N"; 0 without one, none if that is no slot.
std::optional<int> parse_slot(std::string_view query)
{
    if (query == "slot=1") {
        return 1;
    }
    return query.empty() || query == "slot=0" ? std::optional(0) : std::nullopt;
}

/// Returns a name for a header, without characters that could end it.
std::string header_name(const std::string& name)
{
    std::string result;
    for (const char c : name) {
        const bool is_plain = c >= ' ' && c <= '~' && c != '"' && c != '\\';
        result += is_plain ? c : '_';
    }
    return result;
}

}  // namespace

Connection::Connection(asio::ip::tcp::socket socket, ServerState& server)
    : stream_(std::move(socket)),
      server_(server),
      place_(server.strangers.insert(server.strangers.end(), this))
{}

Connection::~Connection()
{
    leave();
}

void Connection::leave()
{
    if (standing_ == Standing::stranger) {
        server_.strangers.erase(place_);
    } else if (standing_ == Standing::client) {
        --server_.clients;
    }
    standing_ = Standing::none;
}

bool Connection::become_client()
{
    if (standing_ == Standing::stranger && server_.clients < max_clients) {
        leave();
        standing_ = Standing::client;
        ++server_.clients;
    }
    return standing_ == Standing::client;
}

void Connection::close()
{
    leave();
    stream_.close();
}

void Connection::read()
{
    parser_.emplace();
    parser_->header_limit(max_header_bytes);
    stream_.expires_after(patience);
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](const error_code& error, std::size_t) { self->take(error); });
}

void Connection::take(const error_code& error)
{
    if (error == http::error::header_limit || error == http::error::buffer_overflow) {
        refuse(431, "the header is too long");
        return;
    }
    if (error == http::error::end_of_stream || error == beast::error::timeout ||
        server_.is_closing) {
        return;
    }
    if (error && error.category() != http::make_error_code(http::error::bad_method).category()) {
        return;  // the connection is gone
    }
    if (error) {
        refuse(400, "this is not a request");
        return;
    }
    serve();
}

void Connection::serve()
{
    const auto& request = parser_->get();
    const auto host = request[http::field::host];
    const auto origin = request.find(http::field::origin);
    if (request.count(http::field::host) > 1) {
        refuse(400, "a request must have one Host");
        return;
    }
    const RequestHead head{
        .method = to_view(request.method_string()),
        .target = to_view(request.target()),
        .host = to_view(host),
        .origin = origin != request.end() ? std::optional(to_view(origin->value())) : std::nullopt};
    if (server_.access->redeem(head)) {
        Response page = response(303, "text/plain; charset=utf-8");
        page.set(http::field::location, server_.access->page());
        page.keep_alive(false);
        send(std::move(page));
        return;
    }
    if (const auto refusal = server_.access->refusal(head)) {
        refuse(refusal->status, refusal->line);
        return;
    }
    if (!become_client()) {
        refuse(503, "too many windows are open");
        return;
    }
    if (parser_->chunked() || parser_->content_length().value_or(0) > 0) {
        refuse(413, "a request must not have a body");
        return;
    }
    const std::string path(Access::parse_path(head.target));
    if (path == "socket" && websocket::is_upgrade(request)) {
        open_window();
    } else if (path == "socket") {
        refuse(426, "this is for web sockets");
    } else if (path.empty()) {
        Response page = response(200, "text/html; charset=utf-8");
        page.body() = server_.page;
        send(std::move(page));
    } else if (path == "save.png" || path == "save.exr" || path == "save.json") {
        save(path);
    } else {
        refuse(404, "there is no such page");
    }
}

void Connection::save(const std::string& name)
{
    const auto slot = parse_slot(Access::parse_query(to_view(parser_->get().target())));
    if (!slot) {
        refuse(404, "there is no such slot");
        return;
    }
    stream_.expires_never();
    server_.session->save(name, *slot, [self = shared_from_this()](Download file) {
        asio::post(self->stream_.get_executor(), [self, file = std::move(file)]() mutable {
            if (file.status != 200) {
                self->refuse(file.status, file.content);
                return;
            }
            Response answer = self->response(200, file.type);
            answer.set(http::field::content_disposition,
                       "attachment; filename=\"" + header_name(file.name) + "\"");
            answer.body() = std::move(file.content);
            self->send(std::move(answer));
        });
    });
}

void Connection::open_window()
{
    stream_.expires_never();     // web sockets have their own time-outs
    standing_ = Standing::none;  // the window counts instead
    std::make_shared<Window>(std::move(stream_), server_)->open(parser_->get());
}

Connection::Response Connection::response(int status, const std::string& type) const
{
    Response answer{static_cast<http::status>(status), 11};
    answer.set(http::field::content_type, type);
    answer.set(http::field::cache_control, "no-store");
    answer.set("Referrer-Policy", "no-referrer");
    answer.set("X-Content-Type-Options", "nosniff");
    answer.set("X-Frame-Options", "DENY");
    answer.set("Cross-Origin-Resource-Policy", "same-origin");
    // Older browsers do not count web sockets as 'self'.
    const auto host = parser_->get()[http::field::host];
    answer.set("Content-Security-Policy",
               "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; "
               "img-src data: blob:; connect-src 'self' ws://" +
                   (server_.access && status == 200 ? std::string(to_view(host)) : "localhost") +
                   "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    return answer;
}

void Connection::refuse(int status, const std::string& line)
{
    Response answer = response(status, "text/plain; charset=utf-8");
    answer.body() = line + "\n";
    answer.keep_alive(false);
    send(std::move(answer));
}

void Connection::send(Response answer)
{
    auto kept = std::make_shared<Response>(std::move(answer));
    kept->keep_alive(kept->keep_alive() && parser_->get().keep_alive());
    kept->prepare_payload();
    stream_.expires_after(3 * patience);
    http::async_write(
        stream_, *kept, [self = shared_from_this(), kept](const error_code& error, std::size_t) {
            if (!error && kept->keep_alive()) {
                self->read();
                return;
            }
            error_code ignored;
            self->stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
        });
}

Window::Window(beast::tcp_stream stream, ServerState& server)
    : stream_(std::move(stream)), server_(server), client_(server.next_client++)
{}

Window::~Window()
{
    --server_.clients;
    server_.windows.erase(client_);
    if (is_open_ && !server_.is_closing) {
        server_.session->leave(client_);
    }
}

void Window::open(const http::request<http::empty_body>& request)
{
    websocket::stream_base::timeout times =
        websocket::stream_base::timeout::suggested(beast::role_type::server);
    times.idle_timeout = std::chrono::seconds(60);
    times.handshake_timeout = std::chrono::seconds(1);  // also after a frame that is no frame
    times.keep_alive_pings = true;
    stream_.set_option(times);
    stream_.read_message_max(max_message_bytes);
    stream_.async_accept(request, [self = shared_from_this()](const error_code& error) {
        if (error) {
            return;
        }
        self->is_open_ = true;
        self->server_.windows[self->client_] = self;
        self->server_.session->join(self->client_);
        self->has_news_ = !self->server_.text.empty();
        self->frames_ = self->server_.frames;
        self->write();
        self->read();
    });
}

void Window::read()
{
    stream_.async_read(buffer_, [self = shared_from_this()](const error_code& error, std::size_t) {
        if (error) {
            return;  // the window is closed, or sent an invalid message
        }
        // Requests of a client that does not read its answers are dropped.
        if (self->answers_.size() < max_waiting_answers) {
            self->server_.session->ask(self->client_,
                                       beast::buffers_to_string(self->buffer_.data()));
            self->buffer_.consume(self->buffer_.size());
            self->read();
        } else {
            self->close();
        }
    });
}

void Window::tell()
{
    has_news_ = true;
    write();
}

void Window::show(const std::shared_ptr<const Frame>& frame)
{
    frames_.at(frame->slot) = frame;
    write();
}

void Window::answer(std::string text)
{
    answers_.push_back(std::move(text));
    write();
}

void Window::write()
{
    if (is_writing_ || !is_open_) {
        return;
    }
    const auto done = [self = shared_from_this()](const error_code& error, std::size_t) {
        self->sent(error);
    };
    if (!answers_.empty()) {
        text_ = std::move(answers_.front());
        answers_.pop_front();
    } else if (std::exchange(has_news_, false)) {
        text_ = server_.text;
    } else {
        frame_ =
            frames_[0] ? std::exchange(frames_[0], nullptr) : std::exchange(frames_[1], nullptr);
        if (!frame_) {
            return;
        }
        is_writing_ = true;
        header_ = frame_header(*frame_, client_);
        stream_.binary(true);
        stream_.async_write(
            std::array<asio::const_buffer, 2>{asio::buffer(header_), asio::buffer(frame_->pixels)},
            done);
        return;
    }
    is_writing_ = true;
    stream_.text(true);
    stream_.async_write(asio::buffer(text_), done);
}

void Window::sent(const error_code& error)
{
    is_writing_ = false;
    frame_.reset();
    if (!error) {
        write();
    }
}

void Window::close()
{
    error_code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
}

}  // namespace bdpt::view
