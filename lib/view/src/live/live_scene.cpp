#include "live/live_scene.h"

#include <bdpt/inspect.h>

#include <chrono>
#include <glm/geometric.hpp>
#include <system_error>
#include <variant>

#include "options/groups/view_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::view {

namespace fs = std::filesystem;

FileStamp read_stamp(const fs::path& file)
{
    std::error_code missing;
    FileStamp stamp;
    stamp.time = fs::last_write_time(file, missing);
    if (missing) {
        return {};
    }
    stamp.bytes = fs::is_regular_file(file, missing) ? fs::file_size(file, missing) : 0;
    stamp.exists = true;
    return stamp;
}

void FileChanges::watch(const std::vector<fs::path>& files)
{
    Stamps known;
    for (const fs::path& file : files) {
        // Keeps the old stamp, as the file may have changed while it was read.
        const auto before = known_.find(file);
        known.emplace(file, before != known_.end() ? before->second : read_stamp(file));
    }
    known_ = std::move(known);
    last_ = known_;
}

bool FileChanges::look()
{
    Stamps now;
    for (const auto& [file, stamp] : known_) {
        now.emplace(file, read_stamp(file));
    }
    const bool rests = now == last_;
    last_ = std::move(now);
    if (!rests || last_ == known_) {
        return false;
    }
    known_ = last_;
    return true;
}

SceneWatch::SceneWatch(std::function<void()> changed)
    : changed_(std::move(changed)),
      thread_([this](const std::stop_token& finished) { run(finished); })
{}

SceneWatch::~SceneWatch()
{
    thread_.request_stop();
    wake_.notify_all();
}

void SceneWatch::watch(const std::vector<fs::path>& files)
{
    const std::lock_guard lock(mutex_);
    changes_.watch(files);
}

void SceneWatch::run(const std::stop_token& finished)
{
    constexpr std::chrono::milliseconds interval{200};
    std::unique_lock lock(mutex_);
    while (!finished.stop_requested()) {
        wake_.wait_for(lock, finished, interval, [] { return false; });
        if (!finished.stop_requested() && changes_.look()) {
            lock.unlock();
            changed_();
            lock.lock();
        }
    }
}

namespace {

std::vector<std::string> choice_of_file(const ViewWords& words)
{
    std::vector<std::string> texts;
    for (const char* option : {"--env", "--variant", "--animation", "--frame-time"}) {
        texts.push_back(words.text(option));
    }
    return texts;
}

}  // namespace

void LiveScene::load(const ViewWords& words)
{
    const RenderArguments asked = words.arguments();
    // Two scenes of this size would not fit.
    if (stage_ && stage_->memory.spent() > stage_->memory.limit().bytes / 2) {
        let_go_();
        still_.reset();
        stage_.reset();
    }
    RenderArguments as_in_file = asked;
    as_in_file.environment_change = {};
    as_in_file.scene.images = images_;
    PreparedScene loaded = prepare_within_memory(as_in_file, console_);
    console_.end_progress();
    let_go_();
    still_.reset();
    stage_.emplace(std::move(loaded));
    environment_change_ = {};
    loaded_ = choice_of_file(words);
    arguments_ = asked;
    change_environment(asked.environment_change);
}

void LiveScene::show(const ViewWords& words)
{
    if (!stage_ || choice_of_file(words) != loaded_) {
        const bool has_room = stage_ && stage_->memory.spent() < stage_->memory.limit().bytes / 4;
        if (!images_ && has_room) {  // the user may try one moment after another
            images_ = std::make_shared<io::ImageCache>(image_cache_bytes(words.arguments()));
        }
        load(words);
        return;
    }
    const RenderArguments asked = words.arguments();
    Viewpoint seen = viewpoint(*stage_, asked);
    change_environment(asked.environment_change);
    stage_->camera = std::move(seen.camera);
    stage_->size = seen.size;
    arguments_ = asked;
}

void LiveScene::change_environment(const EnvironmentChange& change)
{
    if (change == environment_change_) {
        return;
    }
    const Scene& base = still_ ? *still_ : stage_->scene;
    for (const LightDesc& light : base.description().lights) {
        if (const auto* environment = std::get_if<EnvironmentLightDesc>(&light)) {
            Scene edited = base.with_environment(changed(*environment, change));
            let_go_();
            if (!still_) {
                still_ = stage_->scene;
            }
            stage_->scene = std::move(edited);
            break;
        }
    }
    environment_change_ = change;
}

std::vector<std::filesystem::path> LiveScene::files() const
{
    return stage_ ? input_files(arguments_, *stage_) : input_files(arguments_);
}

std::optional<Vec3> LiveScene::picked(int x, int y) const
{
    RenderOptions options = arguments_.options;
    options.integrator = IntegratorKind::pt;
    options.film.width = stage_->size.width;
    options.film.height = stage_->size.height;
    options.film.crop.reset();
    options.film.aovs = {};
    options.bidirectional = {};
    options.sampling.rates.reset();
    const InspectedSample sample = inspect_sample(stage_->scene, stage_->camera, options,
                                                  PixelSample{.x = x, .y = y, .index = 0});
    for (const InspectedVertex& vertex : sample.camera_path) {
        if (vertex.kind == InspectedKind::surface || vertex.kind == InspectedKind::medium) {
            return vertex.position;
        }
    }
    return std::nullopt;
}

Pose LiveScene::pose() const
{
    if (arguments_.view.from && arguments_.view.look_at) {
        const DVec3& origin = stage_->scene.description().origin;
        return {.from = to_world(*arguments_.view.from, origin),
                .look_at = to_world(*arguments_.view.look_at, origin)};
    }
    const CameraDesc& camera = stage_->camera;
    const Pose one_away = compute_pose(camera, 1.0f);
    const Vec3 forward = one_away.look_at - one_away.from;
    const auto hit = picked(stage_->size.width / 2, stage_->size.height / 2);
    const Bounds bounds = stage_->scene.bounds();
    const Vec3 target = hit.value_or(0.5f * (bounds.min + bounds.max));
    const float distance = glm::dot(target - one_away.from, forward);
    const float fallback = 0.5f * glm::length(bounds.max - bounds.min);
    return compute_pose(camera, distance > 0.0f ? distance : fallback > 0.0f ? fallback : 1.0f);
}

}  // namespace bdpt::view
