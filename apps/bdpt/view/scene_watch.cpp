#include "view/scene_watch.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace bdpt::app {

namespace fs = std::filesystem;

FileStamp read_stamp(const fs::path& file)
{
    std::error_code missing;
    FileStamp stamp;
    stamp.time = fs::last_write_time(file, missing);
    if (missing) {
        return {};
    }
    stamp.bytes = fs::is_regular_file(file, missing) ? fs::file_size(file, missing) : 0;
    stamp.exists = true;
    return stamp;
}

void FileChanges::watch(const std::vector<fs::path>& files)
{
    Stamps known;
    for (const fs::path& file : files) {
        // Keeps the old stamp, as the file may have changed while it was read.
        const auto before = known_.find(file);
        known.emplace(file, before != known_.end() ? before->second : read_stamp(file));
    }
    known_ = std::move(known);
    last_ = known_;
}

bool FileChanges::look()
{
    Stamps now;
    for (const auto& [file, stamp] : known_) {
        now.emplace(file, read_stamp(file));
    }
    const bool rests = now == last_;
    last_ = std::move(now);
    if (!rests || last_ == known_) {
        return false;
    }
    known_ = last_;
    return true;
}

SceneWatch::SceneWatch(std::function<void()> changed)
    : changed_(std::move(changed)),
      thread_([this](const std::stop_token& finished) { run(finished); })
{}

SceneWatch::~SceneWatch()
{
    thread_.request_stop();
    wake_.notify_all();
}

void SceneWatch::watch(const std::vector<fs::path>& files)
{
    const std::lock_guard lock(mutex_);
    changes_.watch(files);
}

void SceneWatch::run(const std::stop_token& finished)
{
    constexpr std::chrono::milliseconds interval{200};
    std::unique_lock lock(mutex_);
    while (!finished.stop_requested()) {
        wake_.wait_for(lock, finished, interval, [] { return false; });
        if (!finished.stop_requested() && changes_.look()) {
            lock.unlock();
            changed_();
            lock.lock();
        }
    }
}

}  // namespace bdpt::app
