#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stage/prepared_scene.h"
#include "terminal/console.h"
#include "view/view_camera.h"
#include "view/view_words.h"

namespace bdpt::app {

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
    std::string environment_;  ///< as loaded, in the form of --env
};

}  // namespace bdpt::app
