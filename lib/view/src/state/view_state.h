#pragma once

#include <bdpt/inspect.h>
#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>
#include <bdpt/types.h>
#include <bdpt/view.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "options/option_list.h"
#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

/// The page of `bdpt view`, in the terms of the library of jobs.

namespace bdpt::view {

using namespace job;

/// The current view as options of `bdpt render`: those of the command line, as changed by pages.
/// Everything rendered, copied and saved uses them, so that all agree.
class ViewWords {
public:
    /// Takes the options given to `bdpt view` that `bdpt render` has, too. Without an option for
    /// adaptive sampling, all pixels take equally many samples.
    explicit ViewWords(const OptionList& given);

    void set(std::string_view option, std::string text);
    void remove(std::string_view option);
    /// Sets an option to the file at `path`, which a page gave. Commands and jobs have the file's
    /// own name instead: where the user has it is not known to the page.
    void set_given_file(std::string_view option, const std::filesystem::path& path,
                        std::string name);
    /// Returns `text` with the own names of files that pages gave in place of their paths.
    [[nodiscard]] std::string with_own_names(std::string text) const;
    [[nodiscard]] bool has(std::string_view option) const;
    /// Returns the text of an option; empty: not given.
    [[nodiscard]] std::string text(std::string_view option) const;

    /// Parses the words; without --spp and --noise, for `view_samples`. Throws `OptionError` for
    /// texts that are invalid, alone or together.
    [[nodiscard]] const RenderArguments& arguments() const;
    /// Returns the command line that renders the picture with `samples` per pixel to the bit, as
    /// one line for a shell.
    [[nodiscard]] std::string command(std::int64_t samples) const;
    /// Returns the command line of the final render: with --spp, --noise and --adaptive as given to
    /// `bdpt view`, else by the defaults of `bdpt render`.
    [[nodiscard]] std::string final_command() const;
    /// Returns the job of the final render (options/job_file.h). All its paths are absolute, as it
    /// may be saved anywhere.
    [[nodiscard]] std::string final_job() const;

    [[nodiscard]] bool operator==(const ViewWords& other) const { return texts_ == other.texts_; }

private:
    /// Stores all texts into `options`, which are those of `bdpt render`.
    void give_to(OptionList& options) const;
    /// Returns the words with --spp instead of all options that end a render.
    [[nodiscard]] ViewWords ending_after(std::int64_t samples) const;
    [[nodiscard]] ViewWords final_words() const;
    [[nodiscard]] std::string line() const;

    bool sets_adaptive_ = false;                  ///< --adaptive was not given
    std::map<std::string, std::string> given_{};  ///< own names of files of pages, by path
    std::map<std::string, std::vector<std::string>, std::less<>> texts_;  ///< by name of option
    mutable std::shared_ptr<const RenderArguments> arguments_{};  ///< of `texts_`; null: not parsed
};

/// Position of a camera, and its target [m], in the world.
struct Pose {
    Vec3 from{0.0f};
    Vec3 look_at{0.0f};
    [[nodiscard]] bool operator==(const Pose&) const = default;
};

/// Motion of the camera by the user's hand.
struct Move {
    Vec2 orbit{0.0f};    ///< [rad]; the scene turns to the right and down about `look_at`
    Vec2 pan{0.0f};      ///< [heights of the image]; the scene moves to the right and down
    float dolly = 1.0f;  ///< factor of the distance
    /// Appends the next motion.
    Move& operator+=(const Move& next);
};

/// Returns the pose after `move`. `height` is the visible height of a plane at distance 1 [m].
[[nodiscard]] Pose moved(const Pose& pose, const Move& move, float height);

/// Returns the visible height of a plane at distance 1 for a perspective camera; for an
/// orthographic one the visible height of any plane over `distance` [m].
[[nodiscard]] float view_height(const CameraDesc& camera, float distance);

/// Returns the position of the camera, and its target at `distance`.
[[nodiscard]] Pose compute_pose(const CameraDesc& camera, float distance);

/// Returns the position of `point` in the image of `camera` [pixels]; none: it is not in front of
/// the camera.
[[nodiscard]] std::optional<Vec2> project_point(const CameraDesc& camera, const Size& size,
                                                Vec3 point);

/// Returns the position in the image of points infinitely far away in the unit direction
/// `direction`.
[[nodiscard]] std::optional<Vec2> project_direction(const CameraDesc& camera, const Size& size,
                                                    Vec3 direction);

/// Returns the output of `bdpt inspect --json` for the sample, as one line, with the positions of
/// its vertices in the image: "raster", [x, y] or null. Throws as inspect_sample() does.
[[nodiscard]] std::string inspected_text(const PreparedScene& stage, RenderOptions options,
                                         const PixelSample& pixel);

/// Contents of a picture.
enum class ViewLayer : std::uint8_t { picture, noise, rates, strategy };

[[nodiscard]] std::string_view layer_name(ViewLayer layer);

/// Settings that a page requests; only those that are set.
struct ViewSettings {
    /// Options of `bdpt render` with their texts; empty: without the option. An --env of "scene" is
    /// the scene's own, and an --exposure of "auto" that of the command line.
    std::vector<std::pair<std::string, std::string>> options{};
    std::optional<std::string> integrator_b{};  ///< "": no second one
    std::optional<bool> paused{};
    std::optional<bool> denoises{};  ///< the picture in pages, not files
    std::optional<ViewLayer> layer{};
    std::optional<Strategy> strategy{};
};

/// A page's request to the session.
struct PageRequest {
    std::uint32_t sequence = 0;  ///< number that its answer refers to
    std::optional<Move> move{};
    std::optional<std::array<int, 2>> focus{};  ///< pixel
    bool turns = true;                          ///< `focus` is the camera's new target, too
    bool reset = false;                         ///< resets the camera
    std::optional<ViewSettings> settings{};
    std::optional<PixelSample> inspect{};

    /// Tests whether the request changes the view, which makes the current picture obsolete.
    [[nodiscard]] bool changes_picture() const;
};

/// Parses the message `text`. Throws `Error` (usage), one line, for an invalid request.
[[nodiscard]] PageRequest parse_request(std::string_view text);

/// Returns the number that the answer to `text` refers to, whatever else is wrong with it; none: it
/// has no number.
[[nodiscard]] std::optional<std::uint32_t> parse_sequence(std::string_view text);

}  // namespace bdpt::view
