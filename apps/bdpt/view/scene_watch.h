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

/// What is compared of a file.
struct FileStamp {
    std::filesystem::file_time_type time{};
    std::uintmax_t bytes = 0;
    bool exists = false;
    [[nodiscard]] bool operator==(const FileStamp&) const = default;
};

[[nodiscard]] FileStamp stamp_of(const std::filesystem::path& file);

/// Tells when files have changed, and stay as they are for a moment: programs write them in
/// several steps.
class FileChanges {
public:
    /// What is watched from now on. A file that is new here is known as it is now.
    void watch(const std::vector<std::filesystem::path>& files);
    /// Looks at all files. True: some differ from what they were when `watch` or this said so, and
    /// are as they were at the look before.
    [[nodiscard]] bool look();

private:
    using Stamps = std::map<std::filesystem::path, FileStamp>;
    Stamps known_;
    Stamps last_;
};

/// Looks at files five times a second, on a thread of its own.
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
    std::jthread thread_;  // last: it uses all of the above
};

}  // namespace bdpt::app
