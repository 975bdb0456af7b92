#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "live/live_scene.h"
#include "options/output_files.h"
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
    /// Changes options (`ViewSettings`) of the view of `scene`. Throws `Error` for what the scene
    /// does not have, and for files, which pages may not choose.
    void change(const std::vector<std::pair<std::string, std::string>>& options,
                const LiveScene& scene);
    /// Chooses the environment `file`, which a page gave under that name.
    void choose_given(const std::string& name, const std::filesystem::path& file);
    /// Lets pages choose it again, unless they have given many since.
    void keep_given(const std::string& name, std::shared_ptr<const TemporaryFolder> folder);
    using Given = std::map<std::string, std::shared_ptr<const TemporaryFolder>>;
    /// Returns the environments that pages gave, by name.
    [[nodiscard]] const Given& given() const { return given_; }
    /// Goes back to words that could be shown.
    void give_up(const ViewWords& words);

private:
    void change(const std::string& option, const std::string& text, const LiveScene& scene);
    /// Puts the camera of `scene` at `pose`, by options.
    void place_camera(const Pose& pose, const LiveScene& scene);
    /// Focuses on `target`; a camera that does not turn needs a lens.
    void focus(Vec3 target, const Pose& pose, const PageRequest& request, const LiveScene& scene);
    void set_camera(const std::string& name, const LiveScene& scene);
    void set_field_of_view(const std::string& degrees, const LiveScene& scene);
    void set_aperture(const std::string& f_stop, const LiveScene& scene);
    void set_ground(const std::string& kind);
    void set_background(const std::string& text);
    void set_environment(const std::string& name);
    void set_or_remove(const std::string& option, const std::string& text);
    /// Sets the option as on the command line.
    void restore(const std::string& option);

    ViewWords first_words_;
    ViewWords words_;
    std::optional<Pose> pose_;
    Given given_;
};

}  // namespace bdpt::view
