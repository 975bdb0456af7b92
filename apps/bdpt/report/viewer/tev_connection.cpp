#include "report/viewer/tev_connection.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace bdpt::app {
namespace {

constexpr double patience = 10.0;  // [s] to wait for a viewer that accepts nothing
constexpr int interval = 100;      // [ms] between polls of `stopped`

[[noreturn]] void fail(int error)
{
    throw std::runtime_error(std::system_category().message(error));
}

struct FreeAddresses {
    void operator()(addrinfo* list) const { ::freeaddrinfo(list); }
};

std::unique_ptr<addrinfo, FreeAddresses> look_up(const DisplayAddress& address)
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

}  // namespace

TevConnection::TevConnection(const DisplayAddress& address, const std::function<bool()>& stopped)
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

TevConnection::~TevConnection()
{
    ::close(socket_);
}

bool TevConnection::wait_until_writable(double seconds) const
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

void TevConnection::send(std::string_view bytes) const
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

bool TevConnection::is_closed() const
{
    char byte = 0;
    const ssize_t got = ::recv(socket_, &byte, 1, MSG_DONTWAIT);
    return got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR);
}

}  // namespace bdpt::app
