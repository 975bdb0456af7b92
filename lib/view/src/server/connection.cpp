#include "server/connection.h"

#include <bdpt/error.h>

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <chrono>
#include <limits>
#include <utility>

#include "messages/text.h"
#include "options/output_files.h"
#include "options/render_arguments.h"

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
constexpr std::uint64_t max_file_bytes = std::uint64_t{256} << 20U;

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

constexpr const char* too_large = "the file has more than 256 MiB";

/// Tests whether `name` is that of a file in a folder, and of no word of --env.
bool is_plain_name(const std::string& name)
{
    constexpr std::size_t longest = 200;
    const bool is_printable = one_line(name) == name;
    return is_printable && !name.empty() && name.size() <= longest && !name.starts_with('.') &&
           name.find_first_of("/\\") == std::string::npos && name != "-" && name != "scene" &&
           is_file_of_environment(name);
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

/// A file that a page gives.
struct Connection::Upload {
    Upload(ServerState& state, Parser&& head, std::string file_name)
        : server(state), parser(std::move(head)), name(std::move(file_name))
    {
        server.takes_file = true;
    }
    ~Upload() { server.takes_file = false; }
    Upload(const Upload&) = delete;
    Upload& operator=(const Upload&) = delete;

    ServerState& server;
    http::request_parser<http::file_body> parser;
    std::string name;
    std::shared_ptr<TemporaryFolder> folder = std::make_shared<TemporaryFolder>();
};

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
    keeps_alive_ = false;
    parser_->header_limit(max_header_bytes);
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());  // `serve` refuses bodies
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
    keeps_alive_ = request.keep_alive();
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
    if (head.method == "PUT") {
        take_environment(Access::parse_query(head.target));
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
    server_.session->save(name, *slot, answer_later());
}

std::function<void(Download)> Connection::answer_later()
{
    stream_.expires_never();
    return [self = shared_from_this()](Download file) {
        asio::post(self->stream_.get_executor(),
                   [self, file = std::move(file)]() mutable { self->answer(std::move(file)); });
    };
}

void Connection::answer(Download file)
{
    if (file.status != 200) {
        refuse(file.status, file.content);
        return;
    }
    Response answer = response(200, file.type);
    if (!file.name.empty()) {
        answer.set(http::field::content_disposition,
                   "attachment; filename=\"" + header_name(file.name) + "\"");
    }
    answer.body() = std::move(file.content);
    send(std::move(answer));
}

void Connection::take_environment(std::string_view query)
{
    constexpr std::string_view key = "name=";
    const std::optional<std::string> name =
        query.starts_with(key) ? percent_decoded(query.substr(key.size())) : std::nullopt;
    if (!name || !is_plain_name(*name)) {
        refuse(400, "the file has no name that can be used");
        return;
    }
    if (parser_->content_length().value_or(0) > max_file_bytes) {
        refuse(413, too_large);
        return;
    }
    if (server_.takes_file) {
        refuse(503, "another file is being sent");
        return;
    }
    try {
        upload_ = std::make_unique<Upload>(server_, std::move(*parser_), *name);
    } catch (const Error& error) {
        refuse(500, one_line(error.what()));
        return;
    }
    error_code failure;
    upload_->parser.body_limit(max_file_bytes);
    upload_->parser.get().body().open(upload_->folder->file(*name).c_str(),
                                      beast::file_mode::write_new, failure);
    if (failure) {
        upload_.reset();
        refuse(500, "the file cannot be stored: " + failure.message());
        return;
    }
    read_environment();
}

void Connection::read_environment()
{
    if (upload_->parser.is_done()) {
        give_environment();
        return;
    }
    stream_.expires_after(patience);
    http::async_read_some(stream_, buffer_, upload_->parser,
                          [self = shared_from_this()](const error_code& error, std::size_t) {
                              if (error == http::error::body_limit) {
                                  self->upload_.reset();
                                  self->refuse(413, too_large);
                              } else if (error) {
                                  self->upload_.reset();
                                  self->close();
                              } else {
                                  self->read_environment();
                              }
                          });
}

void Connection::give_environment()
{
    upload_->parser.get().body().close();
    const std::unique_ptr<Upload> upload = std::move(upload_);
    server_.session->take_environment(upload->name, upload->folder, answer_later());
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
    kept->keep_alive(kept->keep_alive() && keeps_alive_);
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
