#include "report/viewer/display.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "report/viewer/tev_connection.h"
#include "report/viewer/tev_message.h"

namespace bdpt::app {
namespace {

using std::chrono::duration;
using std::chrono::duration_cast;

constexpr duration<double> min_image_interval{1.0};
/// Interval of images relative to the time of the last one: developing them takes at most 1 % of
/// the time.
constexpr double interval_of_images = 99.0;
constexpr duration<double> reconnect_interval{2.0};
constexpr duration<double> farewell{2.0};  // wait for the last image
constexpr int band_bytes = 1 << 20;        // approximate size of one message

}  // namespace

Display::Display(DisplayAddress address, Console& console)
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
    const duration<double> taken = end - start;
    const duration<double> interval = std::max(min_image_interval, interval_of_images * taken);
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

}  // namespace bdpt::app
