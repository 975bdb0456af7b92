#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace bdpt::app {

/// File properties that are compared.
struct FileStamp {
    std::filesystem::file_time_type time{};
    std::uintmax_t bytes = 0;
    bool exists = false;
    [[nodiscard]] bool operator==(const FileStamp&) const = default;
};

[[nodiscard]] FileStamp read_stamp(const std::filesystem::path& file);

/// Detects files that have changed and then stayed unchanged for a moment, as programs write them
/// in several steps.
class FileChanges {
public:
    /// Sets the watched files. The current state of newly watched files counts as known.
    void watch(const std::vector<std::filesystem::path>& files);
    /// Checks all files. Returns true if some differ from the last known state and are unchanged
    /// since the previous check.
    [[nodiscard]] bool look();

private:
    using Stamps = std::map<std::filesystem::path, FileStamp>;
    Stamps known_;
    Stamps last_;
};

/// Checks files five times a second, on its own thread.
class SceneWatch {
public:
    /// `changed` is called on that thread.
    explicit SceneWatch(std::function<void()> changed);
    ~SceneWatch();
    SceneWatch(const SceneWatch&) = delete;
    SceneWatch& operator=(const SceneWatch&) = delete;

    void watch(const std::vector<std::filesystem::path>& files);

private:
    void run(const std::stop_token& finished);

    std::function<void()> changed_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    FileChanges changes_;  // guarded by the mutex
    std::jthread thread_;  // last: uses all of the above
};

}  // namespace bdpt::app
