#pragma once

#include <bdpt/film/film.h>
#include <bdpt/image.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "messages/console.h"
#include "options/value_types.h"

namespace bdpt::job {

/// Shows a running render in the tev image viewer. A separate thread sends the newest image and
/// reconnects when the viewer comes back. It never blocks the render: developing images takes at
/// most 1 % of its time, and nothing without a viewer. A missing viewer causes one warning.
class Display {
public:
    Display(NetworkAddress address, Console& console);
    /// Waits a moment for the viewer to take the last image.
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    /// Sets the name of further images in the viewer.
    void begin_image(const std::string& name);
    /// Shows the film if an update is due. Called between passes.
    void after_pass(const Film& film);
    /// Shows the film, however recent the last update was.
    void finish(const Film& film);

private:
    using Clock = std::chrono::steady_clock;
    enum class Viewer : std::uint8_t { sought, there, away };

    /// An image and its place in the viewer.
    struct Shown {
        std::string name;
        Image image;
        FilmLayout layout;
    };

    void develop(const Film& film);
    void run(const std::stop_token& stop);
    /// Shows images until the viewer disconnects, which throws std::runtime_error, or the thread
    /// stops.
    void serve(const std::stop_token& stop);
    void warn(const std::string& problem);

    NetworkAddress address_;
    Console& console_;
    std::string name_;
    Clock::time_point next_{};  // time of the next development
    bool warned_ = false;       // used by the thread only

    std::mutex mutex_;  // guards the members below
    std::condition_variable_any changed_;
    std::shared_ptr<const Shown> newest_;
    Viewer viewer_ = Viewer::sought;
    std::uint64_t made_ = 0;   // number of images so far
    std::uint64_t shown_ = 0;  // number of the last image sent completely

    std::jthread thread_;  // last: uses all of the above
};

}  // namespace bdpt::job
