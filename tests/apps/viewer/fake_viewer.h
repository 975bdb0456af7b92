#pragma once

#include <bdpt/image.h>

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace bdpt::test {

/// What a viewer does with those who connect.
enum class ViewerHabit : std::uint8_t {
    reads,
    hangs,      ///< takes the connection, and not a byte
    dies_once,  ///< closes the first connection after the first pixels
};

/// An image viewer on a port of this machine, which understands as much of tev's protocol as a
/// renderer needs, by its own reading of bytes.
class FakeViewer {
public:
    explicit FakeViewer(ViewerHabit habit);
    ~FakeViewer();
    FakeViewer(const FakeViewer&) = delete;
    FakeViewer& operator=(const FakeViewer&) = delete;

    /// "127.0.0.1:PORT".
    [[nodiscard]] std::string address() const;
    /// Waits until it has had that many connections, all but the last one closed.
    void wait_for_connections(int count);
    /// Waits until nobody is connected.
    void wait_until_alone();
    /// A copy; empty if there is none of that name.
    [[nodiscard]] Image image(const std::string& name);
    /// Messages that were not understood.
    [[nodiscard]] int errors();

private:
    void run();
    void serve(int connection);
    void take(std::string_view message);

    ViewerHabit habit_;
    int listener_ = -1;
    int port_ = 0;
    std::mutex mutex_;  // guards what follows
    std::condition_variable changed_;
    std::map<std::string, Image> images_;
    int connections_ = 0;
    bool connected_ = false;
    int updates_ = 0;
    int errors_ = 0;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace bdpt::test
