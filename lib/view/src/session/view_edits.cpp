#include "session/view_edits.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
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

/// Throws `Error` unless `text` is empty, or a name or an index of `names`.
void check_name(const char* what, const std::string& text, const std::vector<std::string>& names)
{
    const std::optional<std::size_t> index = parse_index(text);
    if (!text.empty() && !is_among(names, text) && !(index && *index < names.size())) {
        throw Error(ErrorCode::usage, fmt::format("\"{}\": there is none \"{}\"", what, text));
    }
}

}  // namespace

void ViewEdits::set_or_remove(const std::string& option, const std::string& text)
{
    if (text.empty()) {
        words_.remove(option);
    } else {
        words_.set(option, text);
    }
}

void ViewEdits::restore(const std::string& option)
{
    set_or_remove(option, first_words_.text(option));
}

void ViewEdits::reset_camera()
{
    for (const char* option :
         {"--camera", "--view", "--margin", "--from", "--look-at", "--ortho", "--fov",
          "--focal-length", "--lens-radius", "--f-stop", "--focus-distance"}) {
        restore(option);
    }
    pose_.reset();
}

void ViewEdits::move_camera(const PageRequest& request, const LiveScene& scene)
{
    const CameraDesc& camera = scene.stage().camera;
    Pose pose = pose_ ? *pose_ : scene.pose();
    if (request.focus) {
        const auto [x, y] = *request.focus;
        const std::optional<Vec3> target = scene.picked(x, y);
        if (!target) {
            throw Error(ErrorCode::usage, "there is no surface here");
        }
        focus(*target, pose, request, scene);
        if (!request.turns) {
            return;
        }
        pose.look_at = *target;
    }
    if (request.move) {
        pose =
            moved(pose, *request.move, view_height(camera, glm::length(pose.look_at - pose.from)));
    }
    place_camera(pose, scene);
}

void ViewEdits::focus(Vec3 target, const Pose& pose, const PageRequest& request,
                      const LiveScene& scene)
{
    const bool has_lens = scene.stage().camera.lens_radius > 0.0f;
    const Vec3 offset = target - pose.from;
    if (has_lens || words_.has("--focus-distance")) {
        const Vec3 axis = glm::normalize(request.turns ? offset : pose.look_at - pose.from);
        words_.set("--focus-distance", fmt::format("{}", glm::dot(offset, axis)));
    } else if (!request.turns) {
        throw Error(ErrorCode::usage, "all is in focus: the lens has no aperture (f-number)");
    }
}

void ViewEdits::place_camera(const Pose& pose, const LiveScene& scene)
{
    const RenderArguments& arguments = scene.arguments();
    const CameraDesc& camera = scene.stage().camera;
    if (arguments.view.projection == Projection::orthographic) {
        throw Error(ErrorCode::usage, "--ortho frames the whole scene; its camera cannot be moved");
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

void ViewEdits::change(const std::vector<std::pair<std::string, std::string>>& options,
                       const LiveScene& scene)
{
    for (const auto& [option, text] : options) {
        change(option, text, scene);
    }
}

void ViewEdits::change(const std::string& option, const std::string& text, const LiveScene& scene)
{
    const io::GltfFacts& facts = scene.stage().facts;
    if (option == "--env") {
        set_environment(text);
    } else if (option == "--camera") {
        set_camera(text, scene);
    } else if (option == "--fov") {
        set_field_of_view(text, scene);
    } else if (option == "--f-stop") {
        set_aperture(text, scene);
    } else if (option == "--background") {
        set_background(text);
    } else if (option == "--ground") {
        set_ground(text);
    } else if (option == "--variant") {
        check_name("variant", text, facts.variant_names);
        set_or_remove(option, text);
    } else if (option == "--animation") {
        check_name("animation", text == "all" ? "" : text, facts.animation_names);
        set_or_remove(option, text);
    } else if (option == "--exposure" && text == "auto") {
        const std::optional<Exposure> first = first_words_.arguments().display.exposure;
        const bool is_fixed = first && first->base == ExposureBase::radiance;
        set_or_remove(option, is_fixed ? text : first_words_.text(option));
    } else {
        set_or_remove(option, text);
    }
}

void ViewEdits::set_camera(const std::string& name, const LiveScene& scene)
{
    if (name != "auto") {
        static_cast<void>(
            select_camera(scene.stage().cameras, name, words_.text("file")));  // throws
    }
    for (const char* option : {"--view", "--margin", "--from", "--look-at", "--ortho", "--fov",
                               "--focal-length", "--focus-distance"}) {
        words_.remove(option);
    }
    words_.set("--camera", name);
    pose_.reset();
}

void ViewEdits::set_field_of_view(const std::string& degrees, const LiveScene& scene)
{
    if (scene.stage().is_framed) {
        place_camera(pose_ ? *pose_ : scene.pose(), scene);  // it would be framed from elsewhere
    }
    words_.remove("--focal-length");
    words_.set("--fov", degrees);
}

void ViewEdits::set_aperture(const std::string& f_stop, const LiveScene& scene)
{
    words_.remove("--lens-radius");
    set_or_remove("--f-stop", f_stop);
    if (!f_stop.empty()) {
        return;
    }
    words_.remove("--focus-distance");
    const std::vector<CameraDesc>& cameras = scene.stage().cameras;
    const auto has_lens = [](const CameraDesc& camera) { return camera.lens_radius > 0.0f; };
    if (std::any_of(cameras.begin(), cameras.end(), has_lens)) {
        words_.set("--lens-radius", "0");
    }
}

void ViewEdits::set_ground(const std::string& kind)
{
    words_.remove("--ground-height");
    if (kind != "none") {
        restore("--ground-height");
    }
    words_.set("--ground", kind);
}

void ViewEdits::set_background(const std::string& text)
{
    const std::optional<Backdrop> backdrop = parse_backdrop(text);
    const bool is_file = !backdrop || !backdrop->photo.empty();
    if (!text.empty() && is_file && text != first_words_.text("--background")) {
        throw Error(
            ErrorCode::usage,
            fmt::format("\"background\": expected transparent or a colour, not \"{}\"", text));
    }
    set_or_remove("--background", text);
}

void ViewEdits::choose_given(const std::string& name, const std::filesystem::path& file)
{
    words_.set_given_file("--env", file, name);
}

void ViewEdits::keep_given(const std::string& name, std::shared_ptr<const TemporaryFolder> folder)
{
    constexpr std::size_t most = 8;  // files that are kept
    if (given_.size() >= most && !given_.contains(name)) {
        const auto other = std::find_if(given_.begin(), given_.end(), [this](const auto& one) {
            return one.second->file(one.first) != words_.text("--env");
        });
        given_.erase(other);
    }
    given_.insert_or_assign(name, std::move(folder));
}

void ViewEdits::set_environment(const std::string& name)
{
    if (name == "scene") {
        words_.remove("--env");
    } else if (const auto found = given_.find(name); found != given_.end()) {
        choose_given(name, found->second->file(name));
    } else if (!is_file_of_environment(name) || name == first_words_.text("--env")) {
        words_.set("--env", name);  // no other file: pages must not choose files to read
    } else {
        throw Error(ErrorCode::usage, fmt::format("\"environment\": there is none \"{}\"", name));
    }
}

}  // namespace bdpt::view
