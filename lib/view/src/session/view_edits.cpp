#include "session/view_edits.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <glm/geometric.hpp>

#include "options/groups/view_arguments.h"
#include "output/values.h"

namespace bdpt::view {
namespace {

/// Returns a point of the world as a value of --from, in coordinates of the file.
std::string point_text(Vec3 point, const DVec3& origin)
{
    if (origin == DVec3(0.0)) {
        return fmt::format("{},{},{}", point.x, point.y, point.z);
    }
    const DVec3 place = to_file(point, origin);
    return fmt::format("{:.12g},{:.12g},{:.12g}", place.x, place.y, place.z);
}

}  // namespace

void ViewEdits::reset_camera()
{
    for (const char* option : {"--camera", "--view", "--margin", "--from", "--look-at", "--ortho",
                               "--fov", "--focal-length", "--focus-distance"}) {
        words_.remove(option);
        if (first_words_.has(option)) {
            words_.set(option, first_words_.text(option));
        }
    }
    pose_.reset();
}

void ViewEdits::move_camera(const PageRequest& request, const LiveScene& scene)
{
    const RenderArguments& arguments = scene.arguments();
    if (arguments.view.projection == Projection::orthographic) {
        throw Error(ErrorCode::usage, "--ortho frames the whole scene; its camera cannot be moved");
    }
    const CameraDesc& camera = scene.stage().camera;
    Pose pose = pose_ ? *pose_ : scene.pose();
    if (request.focus) {
        const auto [x, y] = *request.focus;
        const std::optional<Vec3> target = scene.picked(x, y);
        if (!target) {
            throw Error(ErrorCode::usage, "there is no surface here");
        }
        pose.look_at = *target;
        if (words_.has("--focus-distance")) {
            words_.set("--focus-distance", fmt::format("{}", glm::length(*target - pose.from)));
        }
    }
    if (request.move) {
        pose =
            moved(pose, *request.move, view_height(camera, glm::length(pose.look_at - pose.from)));
    }
    if (arguments.view.frames()) {
        // Options that frame the scene exclude a camera position.
        words_.remove("--view");
        words_.remove("--margin");
        words_.set("--camera", "auto");
    }
    const bool is_framed = arguments.view.frames() || scene.stage().is_framed;
    if (is_framed && !words_.has("--fov") && !words_.has("--focal-length")) {
        // With a field of view the view is complete, so the scene need not be framed.
        words_.set("--fov", fmt::format("{}", degrees(camera.vertical_fov)));
    }
    const DVec3& origin = scene.stage().scene.description().origin;
    words_.set("--from", point_text(pose.from, origin));
    words_.set("--look-at", point_text(pose.look_at, origin));
    pose_ = pose;
}

void ViewEdits::give_up(const ViewWords& words)
{
    words_ = words;
    pose_.reset();
}

void ViewEdits::change(const std::vector<std::pair<std::string, std::string>>& options)
{
    for (const auto& [option, text] : options) {
        if (option == "--env") {
            set_environment(text);
        } else if (option == "--exposure" && text == "auto") {
            const std::optional<Exposure> first = first_words_.arguments().display.exposure;
            if (!first_words_.has(option)) {
                words_.remove(option);
            } else {
                const bool is_fixed = first && first->base == ExposureBase::radiance;
                words_.set(option, is_fixed ? text : first_words_.text(option));
            }
        } else {
            words_.set(option, text);
        }
    }
}

void ViewEdits::set_environment(const std::string& name)
{
    if (name == "scene") {
        words_.remove("--env");
    } else if (name == "none" || name == "default" || name == "studio" ||
               name == first_words_.text("--env")) {
        words_.set("--env", name);  // no other file: pages must not choose files to read
    } else {
        throw Error(ErrorCode::usage, fmt::format("\"environment\": there is none \"{}\"", name));
    }
}

}  // namespace bdpt::view
