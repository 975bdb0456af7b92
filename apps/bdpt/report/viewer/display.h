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

#include "options/values/viewer_address.h"
#include "terminal/console.h"

namespace bdpt::app {

/// Shows a render while it runs in the tev image viewer. A thread of its own sends the newest
/// image, connects again when the viewer comes (back), and never keeps the render waiting: to
/// develop images takes at most 1 % of its time, and nothing while nobody looks. That there is no
/// viewer is a warning, once.
class Display {
public:
    Display(DisplayAddress address, Console& console);
    /// Gives the viewer a moment to take the last image.
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    /// From now on images have this name in the viewer.
    void begin_image(const std::string& name);
    /// Between passes: shows the film when it is time to.
    void after_pass(const Film& film);
    /// Shows the film whenever it was shown last.
    void finish(const Film& film);

private:
    using Clock = std::chrono::steady_clock;
    enum class Viewer : std::uint8_t { sought, there, away };

    /// An image and where it is shown.
    struct Shown {
        std::string name;
        Image image;
        FilmLayout layout;
    };

    void develop(const Film& film);
    void run(const std::stop_token& stop);
    /// Shows images until the viewer goes, which throws std::runtime_error, or the thread stops.
    void serve(const std::stop_token& stop);
    void warn(const std::string& problem);

    DisplayAddress address_;
    Console& console_;
    std::string name_;
    Clock::time_point next_{};  // time to develop
    bool warned_ = false;       // of the thread only

    std::mutex mutex_;  // guards what follows
    std::condition_variable_any changed_;
    std::shared_ptr<const Shown> newest_;
    Viewer viewer_ = Viewer::sought;
    std::uint64_t made_ = 0;   // images so far
    std::uint64_t shown_ = 0;  // of these, the last one that was sent whole

    std::jthread thread_;  // last: it uses all of the above
};

}  // namespace bdpt::app
