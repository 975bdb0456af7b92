#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "messages/console.h"
#include "stage/prepared_scene.h"
#include "state/view_state.h"

namespace bdpt::view {

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

/// The scene of the current words: changes avoid loading if possible.
class LiveScene {
public:
    /// `let_go` is called before a scene is destroyed: nothing may render it from then on.
    LiveScene(Console& console, std::function<void()> let_go)
        : console_(console), let_go_(std::move(let_go))
    {}

    /// Reloads the files. Throws `Error`; then the old scene is kept, unless memory did not suffice
    /// for both.
    void load(const ViewWords& words);
    /// Applies `words`. Throws `Error`; then nothing changes.
    void show(const ViewWords& words);

    [[nodiscard]] bool is_there() const { return stage_.has_value(); }
    /// The functions below require a scene.
    [[nodiscard]] const PreparedScene& stage() const { return *stage_; }
    [[nodiscard]] const RenderArguments& arguments() const { return arguments_; }
    [[nodiscard]] std::vector<std::filesystem::path> files() const;

    /// Returns the first surface or scattering event at a pixel; none: only the environment.
    [[nodiscard]] std::optional<Vec3> picked(int x, int y) const;
    /// Returns the pose of the camera. Its target is the first surface in the middle of the image
    /// or, if there is none, a point as far away as the middle of the scene.
    [[nodiscard]] Pose pose() const;

private:
    void change_environment(const EnvironmentChange& change);

    Console& console_;
    std::function<void()> let_go_;
    RenderArguments arguments_{};
    std::optional<PreparedScene> stage_;
    std::optional<Scene> still_;  ///< without `environment_change_`, if that changes anything
    EnvironmentChange environment_change_{};
    std::vector<std::string> loaded_;         ///< texts of the options that choose what to load
    std::shared_ptr<io::ImageCache> images_;  ///< of scenes that are loaded at other times
};

}  // namespace bdpt::view
