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

/// The scene as words say that it is seen: what they change in it needs no loading, if possible.
class LiveScene {
public:
    /// `let_go` is called before a scene goes: nothing may render it from then on.
    LiveScene(Console& console, std::function<void()> let_go)
        : console_(console), let_go_(std::move(let_go))
    {
    }

    /// Loads the files anew. Throws `Error`; then all stays as it was, unless there was not memory
    /// enough to keep it beside the new one.
    void load(const ViewWords& words);
    /// Shows what `words` say. Throws `Error`; then all stays as it was.
    void show(const ViewWords& words);

    [[nodiscard]] bool is_there() const { return stage_.has_value(); }
    /// The rest is for a scene that is there.
    [[nodiscard]] const PreparedScene& stage() const { return *stage_; }
    [[nodiscard]] const RenderArguments& arguments() const { return arguments_; }
    [[nodiscard]] std::vector<std::filesystem::path> files() const;

    /// The first surface, or scattering, at a pixel; none: there is only sky.
    [[nodiscard]] std::optional<Vec3> picked(int x, int y) const;
    /// What the camera turns about is the first surface in the middle of the image or, where there
    /// is none, as far away as the middle of the scene.
    [[nodiscard]] Pose pose() const;

private:
    void change_environment(const EnvironmentChange& change);

    Console& console_;
    std::function<void()> let_go_;
    RenderArguments arguments_{};
    std::optional<PreparedScene> stage_;
    std::optional<Scene> still_;  ///< without `environment_change_`, where that is any
    EnvironmentChange environment_change_{};
    std::string environment_;  ///< with which it was loaded, as --env has it
};

}  // namespace bdpt::app
