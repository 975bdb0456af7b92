#include "fake_viewer.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace bdpt::test {
namespace {

/// Takes the fields of a message one after the other.
class Fields {
public:
    explicit Fields(std::string_view bytes) : bytes_(bytes) {}
    template <typename Number>
    Number number()
    {
        Number result{};
        const std::string_view bytes = take(sizeof result);
        std::memcpy(&result, bytes.data(), sizeof result);
        return result;
    }
    std::string text()
    {
        const std::size_t end = bytes_.find('\0');
        const std::string result(take(end));
        static_cast<void>(take(1));
        return result;
    }
    std::vector<std::string> texts()
    {
        std::vector<std::string> result(static_cast<std::size_t>(number<std::int32_t>()));
        for (std::string& element : result) {
            element = text();
        }
        return result;
    }
    std::string_view take(std::size_t size)
    {
        if (size > bytes_.size()) {
            throw std::runtime_error("a message that is too short");
        }
        const std::string_view result = bytes_.substr(0, size);
        bytes_.remove_prefix(size);
        return result;
    }
    [[nodiscard]] std::size_t left() const { return bytes_.size(); }

private:
    std::string_view bytes_;
};

const std::vector<std::string> rgb{"R", "G", "B"};

void expect(bool condition)
{
    if (!condition) {
        throw std::runtime_error("a message that makes no sense");
    }
}

}  // namespace

FakeViewer::FakeViewer(ViewerHabit habit)
    : habit_(habit), listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0))
{
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    if (::bind(listener_, any, size) != 0 || ::listen(listener_, 4) != 0 ||
        ::getsockname(listener_, any, &size) != 0) {
        throw std::runtime_error("no port to listen at");
    }
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { run(); });
}

FakeViewer::~FakeViewer()
{
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    thread_.join();
    ::close(listener_);
}

std::string FakeViewer::address() const
{
    return "127.0.0.1:" + std::to_string(port_);
}

void FakeViewer::wait_for_connections(int count)
{
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return connections_ >= count; });
}

void FakeViewer::wait_until_alone()
{
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !connected_; });
}

Image FakeViewer::image(const std::string& name)
{
    const std::lock_guard lock(mutex_);
    return images_[name];
}

int FakeViewer::errors()
{
    const std::lock_guard lock(mutex_);
    return errors_;
}

void FakeViewer::run()
{
    const auto stopped = [this] {
        const std::lock_guard lock(mutex_);
        return stop_;
    };
    while (!stopped()) {
        pollfd wanted{.fd = listener_, .events = POLLIN, .revents = 0};
        if (::poll(&wanted, 1, 20) <= 0) {
            continue;
        }
        const int connection = ::accept(listener_, nullptr, nullptr);
        {
            const std::lock_guard lock(mutex_);
            ++connections_;
            connected_ = true;
        }
        changed_.notify_all();
        if (habit_ == ViewerHabit::hangs) {
            while (!stopped()) {
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
            }
        } else {
            serve(connection);
        }
        ::close(connection);
        {
            const std::lock_guard lock(mutex_);
            connected_ = false;
        }
        changed_.notify_all();
    }
}

void FakeViewer::serve(int connection)
{
    std::string bytes;
    std::array<char, 65536> buffer{};
    for (ssize_t got = 1; got > 0;) {
        std::uint32_t length = 0;
        while (bytes.size() >= sizeof length) {
            std::memcpy(&length, bytes.data(), sizeof length);
            if (bytes.size() < length) {
                break;
            }
            const std::lock_guard lock(mutex_);
            try {
                take(std::string_view(bytes).substr(sizeof length, length - sizeof length));
            } catch (const std::runtime_error&) {
                ++errors_;
            }
            bytes.erase(0, length);
            if (habit_ == ViewerHabit::dies_once && connections_ == 1 && updates_ > 0) {
                images_.clear();
                return;
            }
        }
        got = ::recv(connection, buffer.data(), buffer.size(), 0);
        bytes.append(buffer.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
    }
}

void FakeViewer::take(std::string_view message)
{
    Fields fields(message);
    const auto kind = fields.number<std::uint8_t>();
    static_cast<void>(fields.number<std::uint8_t>());  // whether to come to the front
    const std::string name = fields.text();
    if (kind == 4) {
        Image image{.width = fields.number<std::int32_t>(),
                    .height = fields.number<std::int32_t>(),
                    .pixels = {}};
        expect(fields.texts() == rgb && fields.left() == 0);
        image.pixels.resize(static_cast<std::size_t>(image.width * image.height), Rgb(-1.0f));
        images_[name] = std::move(image);
        return;
    }
    expect(kind == 6 && images_.contains(name) && fields.texts() == rgb);
    Image& image = images_[name];
    const auto x = fields.number<std::int32_t>();
    const auto y = fields.number<std::int32_t>();
    const auto width = fields.number<std::int32_t>();
    const auto height = fields.number<std::int32_t>();
    expect(x >= 0 && y >= 0 && x + width <= image.width && y + height <= image.height);
    std::array<std::int64_t, 6> offsets_and_strides{};
    for (std::int64_t& number : offsets_and_strides) {
        number = fields.number<std::int64_t>();
    }
    std::vector<float> values(fields.left() / sizeof(float));
    expect(values.size() == static_cast<std::size_t>(3 * width * height));
    std::memcpy(values.data(), fields.take(fields.left()).data(), values.size() * sizeof(float));
    for (int i = 0; i < width * height; ++i) {
        Rgb& pixel =
            image.pixels[static_cast<std::size_t>((y + i / width) * image.width + x + i % width)];
        for (int c = 0; c < 3; ++c) {
            const auto channel = static_cast<std::size_t>(c);
            pixel[c] = values.at(static_cast<std::size_t>(offsets_and_strides[channel] +
                                                          i * offsets_and_strides[channel + 3]));
        }
    }
    ++updates_;
}

}  // namespace bdpt::test
