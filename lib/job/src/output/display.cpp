#include "output/display.h"

#include <fmt/core.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <functional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

namespace bdpt::job {
namespace {

// Messages of the tev image viewer's protocol over TCP [github.com/Tom94/tev, "inter-process
// communication" in its README]: total length in four bytes, a byte with the type of the message,
// and its fields, integers in little-endian order and strings with a zero at their end.

static_assert(std::endian::native == std::endian::little, "numbers are sent as they are in memory");

enum class MessageKind : std::uint8_t { create_image = 4, update_image = 6 };

constexpr std::array<std::string_view, 3> channels{"R", "G", "B"};

/// Builds a message with its length in front.
class Message {
public:
    explicit Message(MessageKind kind)
    {
        add(std::uint32_t{0});
        add(static_cast<std::uint8_t>(kind));
    }
    template <typename Number>
    void add(Number number)
    {
        static_assert(std::is_arithmetic_v<Number>);
        std::array<char, sizeof number> bytes{};
        std::memcpy(bytes.data(), &number, sizeof number);
        bytes_.append(bytes.data(), bytes.size());
    }
    void add(std::string_view text)
    {
        bytes_.append(text.substr(0, text.find('\0')));
        bytes_.push_back('\0');
    }
    void add_channels()
    {
        add(static_cast<std::int32_t>(channels.size()));
        for (const std::string_view channel : channels) {
            add(channel);
        }
    }
    void add(std::span<const Rgb> pixels)
    {
        const std::size_t before = bytes_.size();
        bytes_.resize(before + pixels.size_bytes());
        std::memcpy(bytes_.data() + before, pixels.data(), pixels.size_bytes());
    }
    [[nodiscard]] std::string done() &&
    {
        const auto length = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof length);
        return std::move(bytes_);
    }

private:
    std::string bytes_;
};

constexpr std::uint8_t keep_focus = 0;  // the user's selected image stays in front

/// Returns the message that creates an empty image with the channels R, G and B, replacing one of
/// that name.
std::string tev_create_image(std::string_view name, int width, int height)
{
    Message message(MessageKind::create_image);
    message.add(keep_focus);
    message.add(name);
    message.add(std::int32_t{width});
    message.add(std::int32_t{height});
    message.add_channels();
    return std::move(message).done();
}

/// Returns the message that fills rows `first_row` to `end_row` of `image` into the viewer's image;
/// (x, y) is the position of the image's first pixel in it. At least one row.
std::string tev_update_image(std::string_view name, const Image& image, int x, int y, int first_row,
                             int end_row)
{
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    Message message(MessageKind::update_image);
    message.add(keep_focus);
    message.add(name);
    message.add_channels();
    message.add(std::int32_t{x});
    message.add(std::int32_t{y + first_row});
    message.add(std::int32_t{image.width});
    message.add(std::int32_t{end_row - first_row});
    for (std::int64_t channel = 0; channel < 3; ++channel) {
        message.add(channel);  // offset of its first value
    }
    for (int channel = 0; channel < 3; ++channel) {
        message.add(std::int64_t{3});  // stride of its values
    }
    const auto width = static_cast<std::size_t>(image.width);
    message.add(std::span(image.pixels)
                    .subspan(static_cast<std::size_t>(first_row) * width,
                             static_cast<std::size_t>(end_row - first_row) * width));
    return std::move(message).done();
}

constexpr double patience = 10.0;  // [s] to wait for a viewer that accepts nothing
constexpr int interval = 100;      // [ms] between polls of `stopped`

[[noreturn]] void fail(int error)
{
    throw std::runtime_error(std::system_category().message(error));
}

struct FreeAddresses {
    void operator()(addrinfo* list) const { ::freeaddrinfo(list); }
};

std::unique_ptr<addrinfo, FreeAddresses> look_up(const NetworkAddress& address)
{
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* list = nullptr;
    const int error = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &list);
    if (error != 0) {
        throw std::runtime_error(::gai_strerror(error));
    }
    return std::unique_ptr<addrinfo, FreeAddresses>(list);
}

/// A connection to a viewer that never blocks for long: a viewer that accepts no bytes for ten
/// seconds is taken as dead, and `stopped` is polled ten times a second. Throws std::runtime_error.
class TevConnection {
public:
    TevConnection(const NetworkAddress& address, const std::function<bool()>& stopped)
        : stopped_(stopped)
    {
        const auto addresses = look_up(address);
        int error = ECONNREFUSED;
        for (const addrinfo* at = addresses.get(); at != nullptr; at = at->ai_next) {
            socket_ = ::socket(at->ai_family, at->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC,
                               at->ai_protocol);
            if (socket_ < 0) {
                error = errno;
                continue;
            }
            if (::connect(socket_, at->ai_addr, at->ai_addrlen) == 0) {
                return;
            }
            error = errno;
            if (error == EINPROGRESS) {
                error = ETIMEDOUT;
                if (wait_until_writable(patience)) {
                    socklen_t size = sizeof error;
                    ::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size);
                }
            }
            if (error == 0) {
                return;
            }
            ::close(socket_);
        }
        fail(error);
    }
    ~TevConnection() { ::close(socket_); }
    TevConnection(const TevConnection&) = delete;
    TevConnection& operator=(const TevConnection&) = delete;

    /// Throws if the viewer is gone, accepts nothing, or `stopped` returns true.
    void send(std::string_view bytes) const
    {
        while (!bytes.empty()) {
            if (!wait_until_writable(patience)) {
                fail(ETIMEDOUT);
            }
            const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (sent >= 0) {
                bytes.remove_prefix(static_cast<std::size_t>(sent));
            } else if (errno != EAGAIN && errno != EINTR) {
                fail(errno);
            }
        }
    }
    /// Tests whether the viewer has closed the connection.
    [[nodiscard]] bool is_closed() const
    {
        char byte = 0;
        const ssize_t got = ::recv(socket_, &byte, 1, MSG_DONTWAIT);
        return got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR);
    }

private:
    [[nodiscard]] bool wait_until_writable(double seconds) const
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (std::chrono::steady_clock::now() < end && !stopped_()) {
            pollfd wanted{.fd = socket_, .events = POLLOUT, .revents = 0};
            if (::poll(&wanted, 1, interval) > 0) {
                return true;
            }
        }
        return false;
    }

    std::function<bool()> stopped_;
    int socket_ = -1;
};

using Interval = std::chrono::duration<double>;
using std::chrono::duration_cast;

constexpr Interval min_image_interval{1.0};
/// Interval of images relative to the time of the last one: developing them takes at most 1 % of
/// the time.
constexpr double interval_of_images = 99.0;
constexpr Interval reconnect_interval{2.0};
constexpr Interval farewell{2.0};    // wait for the last image
constexpr int band_bytes = 1 << 20;  // approximate size of one message

}  // namespace

Display::Display(NetworkAddress address, Console& console)
    : address_(std::move(address)),
      console_(console),
      thread_([this](const std::stop_token& stop) { run(stop); })
{}

Display::~Display()
{
    {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, farewell,
                          [this] { return viewer_ != Viewer::there || shown_ == made_; });
    }
    thread_.request_stop();
    thread_.join();
}

void Display::begin_image(const std::string& name)
{
    name_ = name;
    next_ = {};
}

void Display::after_pass(const Film& film)
{
    if (Clock::now() < next_) {
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        if (viewer_ != Viewer::there || shown_ != made_) {
            return;  // no viewer, or the last image is still being sent
        }
    }
    develop(film);
}

void Display::finish(const Film& film)
{
    {
        // A short render may end before the viewer was found.
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, farewell, [this] { return viewer_ != Viewer::sought; });
        if (viewer_ != Viewer::there) {
            return;
        }
    }
    develop(film);
}

void Display::develop(const Film& film)
{
    const Clock::time_point start = Clock::now();
    auto shown = std::make_shared<Shown>(
        Shown{.name = name_, .image = film.develop(), .layout = film.layout()});
    const Clock::time_point end = Clock::now();
    const Interval taken = end - start;
    const Interval interval = std::max(min_image_interval, interval_of_images * taken);
    next_ = end + duration_cast<Clock::duration>(interval);
    const std::lock_guard lock(mutex_);
    newest_ = std::move(shown);
    ++made_;
    changed_.notify_all();
}

void Display::run(const std::stop_token& stop)
{
    while (!stop.stop_requested()) {
        try {
            serve(stop);
        } catch (const std::runtime_error& error) {
            if (!stop.stop_requested()) {
                warn(error.what());
            }
        }
        std::unique_lock lock(mutex_);
        viewer_ = Viewer::away;
        shown_ = 0;  // the next viewer has none
        made_ = newest_ ? 1 : 0;
        changed_.notify_all();
        changed_.wait_for(lock, stop, reconnect_interval, [] { return false; });
    }
}

void Display::serve(const std::stop_token& stop)
{
    const TevConnection viewer(address_, [&stop] { return stop.stop_requested(); });
    {
        const std::lock_guard lock(mutex_);
        viewer_ = Viewer::there;
        changed_.notify_all();
    }
    std::string created;
    while (!stop.stop_requested()) {
        std::shared_ptr<const Shown> shown;
        std::uint64_t number = 0;
        {
            std::unique_lock lock(mutex_);
            changed_.wait_for(lock, stop, min_image_interval, [this] { return shown_ != made_; });
            if (shown_ != made_) {
                shown = newest_;
                number = made_;
            }
        }
        if (viewer.is_closed()) {
            throw std::runtime_error("the viewer closed the connection");
        }
        if (!shown || stop.stop_requested()) {
            continue;
        }
        const FilmLayout& layout = shown->layout;
        if (created != shown->name) {
            viewer.send(tev_create_image(shown->name, layout.width, layout.height));
            created = shown->name;
        }
        const Image& image = shown->image;
        const int band = std::max(1, band_bytes / (image.width * static_cast<int>(sizeof(Rgb))));
        for (int row = 0; row < image.height; row += band) {
            viewer.send(tev_update_image(shown->name, image, layout.region.x0, layout.region.y0,
                                         row, std::min(row + band, image.height)));
        }
        const std::lock_guard lock(mutex_);
        shown_ = number;
        changed_.notify_all();
    }
}

void Display::warn(const std::string& problem)
{
    if (!std::exchange(warned_, true)) {
        console_.warning(fmt::format(
            "--display {}:{}: {}; the render continues, and a viewer that starts later shows it",
            address_.host, address_.port, problem));
    }
}

}  // namespace bdpt::job
