#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "live/live_scene.h"
#include "state/view_state.h"

namespace bdpt::view {

/// What pages ask to be shown: options that follow their requests.
class ViewEdits {
public:
    explicit ViewEdits(const ViewWords& words) : first_words_(words), words_(words) {}

    [[nodiscard]] const ViewWords& words() const { return words_; }
    /// Returns the words of the command line.
    [[nodiscard]] const ViewWords& first_words() const { return first_words_; }
    /// Returns the pose of the camera, if it is known.
    [[nodiscard]] const std::optional<Pose>& pose() const { return pose_; }
    void set_pose(const std::optional<Pose>& pose) { pose_ = pose; }

    /// Gives up all changes of the camera.
    void reset_camera();
    /// Moves the camera of `scene`, or turns it to a pixel, as `request` says. Throws `Error`.
    void move_camera(const PageRequest& request, const LiveScene& scene);
    /// Changes options (`ViewSettings`). Throws `Error` for an environment that pages may not
    /// choose.
    void change(const std::vector<std::pair<std::string, std::string>>& options);
    /// Goes back to words that could be shown.
    void give_up(const ViewWords& words);

private:
    void set_environment(const std::string& name);

    ViewWords first_words_;
    ViewWords words_;
    std::optional<Pose> pose_;
};

}  // namespace bdpt::view
