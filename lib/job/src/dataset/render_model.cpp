#include <bdpt/error.h>
#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>
#include <bdpt/tools/pixel_hits.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <chrono>
#include <system_error>
#include <utility>

#include "dataset/dataset.h"
#include "options/output_files.h"
#include "output/image_files.h"
#include "plan/plan.h"
#include "run/run_render.h"
#include "stage/prepared_scene.h"

namespace bdpt::job {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Returns the arguments of `bdpt render` for the model.
RenderArguments arguments_of(const DatasetArguments& arguments, const DatasetModel& model)
{
    RenderArguments asked = with_image_cache(arguments.render);
    asked.file = model.file;
    if (!arguments.environments.empty()) {
        asked.environment =
            drawn_environment(arguments.environments, asked.options.sampling.seed, model.name)
                .string();
    }
    if (!asked.display.exposure) {
        asked.display.exposure = Exposure{.base = ExposureBase::light};  // the same for all views
    }
    return asked;
}

/// Returns the hash of all that the model's views depend on.
ContentHash key_of(const DatasetArguments& arguments, const RenderArguments& asked,
                   const DatasetModel& model)
{
    std::string text = fmt::format("{}\n{}\n", BDPT_VERSION, model.name);
    for (const std::string& word : arguments.key_words) {
        text += word + "\n";
    }
    for (const IdentityComponent& file : identity_of_files(asked).components) {
        text += file.name + " " + file.value + "\n";
    }
    if (arguments.poses) {
        text += to_string(io::hash_of_file(*arguments.poses)) + "\n";
    }
    ContentHasher hasher;
    hasher.add(text.data(), text.size());
    return hasher.hash();
}

/// The views of a model, one after the other.
class ModelRender {
public:
    ModelRender(const DatasetArguments& arguments, const DatasetModel& model,
                const ModelProgress& progress, Interrupt& interrupt)
        : arguments_(arguments),
          model_(model),
          progress_(progress),
          interrupt_(interrupt),
          asked_(arguments_of(arguments, model)),
          folder_(arguments.folder / model.name),
          manifest_(folder_, key_of(arguments, asked_, model))
    {}

    ModelResult run()
    {
        if (!manifest_.is_ours()) {
            if (arguments_.existing == ExistingViews::refuse) {
                throw Error(ErrorCode::output,
                            fmt::format("{}: has views of other options, of a changed model or of "
                                        "another version of bdpt (--restart replaces them)",
                                        folder_.string()));
            }
            manifest_.clear();
        }
        if (manifest_.is_complete()) {
            return {.views = manifest_.count()};
        }
        const auto start = std::chrono::steady_clock::now();
        load(asked_);
        progress_.loaded();
        list_views();
        prepare_folder();
        for (std::size_t i = 0; i < views_.size(); ++i) {
            if (interrupt_.stopped_by() || !render(i)) {
                result_.stopped = true;
                break;
            }
            progress_.viewed(i + 1, views_.size());
        }
        if (!result_.stopped) {
            finish();
        }
        result_.seconds = seconds_since(start);
        return result_;
    }

private:
    struct View {
        std::optional<SequenceView> sequence{};  ///< set for --orbit, --frames and --cameras
        std::optional<PosedCamera> posed{};      ///< set for others
    };
    /// A view whose flow is missing.
    struct Pending {
        std::size_t index = 0;
        PixelHits seen;
        ordered_json line;
    };

    void load(const RenderArguments& image)
    {
        RenderArguments sized = image;
        sized.size = sized.size.value_or(default_view_size);
        stage_.reset();  // first, to avoid two scenes in memory
        stage_.emplace(prepare_within_memory(sized, console_));
        time_ = image.scene.time;
        still_.reset();
        shared_.guides.reset();
        shared_.has_ground.reset();
        for (const std::string& warning : stage_->warnings) {
            warnings_.push_back(warning);
        }
    }

    void list_views()
    {
        first_ = Viewpoint{
            .camera = stage_->camera, .size = stage_->size, .is_framed = stage_->is_framed};
        if (asked_.sequence && !arguments_.poses) {
            for (SequenceView& view : make_views(asked_, camera_names(*stage_))) {
                views_.push_back({.sequence = std::move(view), .posed = {}});
            }
            return;
        }
        for (PosedCamera& posed : posed_cameras(arguments_, stage_->scene, model_.name)) {
            views_.push_back({.sequence = {}, .posed = std::move(posed)});
        }
    }

    void prepare_folder()
    {
        std::error_code error;
        fs::create_directories(folder_, error);
        if (error) {
            throw Error(ErrorCode::output,
                        fmt::format("{}: cannot create: {}", folder_.string(), error.message()));
        }
        denoiser_ = open_denoiser(asked_.denoise, std::vector{image_file(0)},
                                  asked_.options.system.threads);
        masks_ = mask_numbers(arguments_, stage_->scene);
        if (!masks_.empty()) {
            write_mask_names(folder_, masks_);
        }
    }

    /// Returns "0012": at least four digits, as many for all views.
    [[nodiscard]] std::string number(std::size_t index) const
    {
        const std::size_t digits = std::max<std::size_t>(
            4, std::to_string(std::max<std::size_t>(views_.size(), 1) - 1).size());
        return fmt::format("{:0{}}", index, digits);
    }
    [[nodiscard]] fs::path image_file(std::size_t index) const
    {
        return folder_ / fmt::format("{}.{}", number(index), arguments_.image_type);
    }
    [[nodiscard]] std::vector<std::string> files(std::size_t index) const
    {
        return view_files(arguments_, number(index), index + 1 == views_.size());
    }

    /// Returns the arguments of a view, and sets the camera of the stage.
    RenderArguments pose(std::size_t index)
    {
        const View& view = views_[index];
        RenderArguments image = asked_;
        if (view.sequence) {
            image = make_view_arguments(asked_, *view.sequence);
            if (image.scene.time != time_) {
                load(image);
            }
            Viewpoint seen = sequence_viewpoint(*stage_, *first_, image);
            stage_->camera = std::move(seen.camera);
            stage_->size = seen.size;
            if (view.sequence->turn && asked_.sequence->motion == TurntableMotion::object) {
                if (!still_) {
                    still_ = stage_->scene;
                }
                stage_->scene = with_turned_environment(*still_, *view.sequence->turn);
            }
        } else {
            image.options.sampling.seed =
                seed_of_frame(asked_.options.sampling.seed, static_cast<int>(index));
            SequenceView& sequence = image.sequence_view.emplace();
            sequence.frame = static_cast<int>(index);
            sequence.index = index;
            sequence.count = views_.size();
            stage_->camera = view.posed->camera;
            stage_->camera.name = number(index);
            stage_->size = view.posed->size;
        }
        image.size = stage_->size;
        image.outputs = {image_file(index)};
        return image;
    }

    /// Meters the light of the first view, for the exposure of all, also if it was rendered before.
    void meter()
    {
        const RenderArguments image = pose(0);
        shared_.is_metered = true;
        if (meters_light(image, *stage_)) {
            shared_.exposure = metered_exposure(stage_->scene, stage_->camera, stage_->size);
        }
    }

    /// Renders a view unless it is there, and finishes the one before. Returns false if it was
    /// stopped.
    bool render(std::size_t index)
    {
        const auto start = std::chrono::steady_clock::now();
        RenderArguments image = pose(index);
        records_.push_back(record(index, image));
        if (pending_) {
            write_flow(folder_, number(pending_->index), pending_->seen,
                       optical_flow(pending_->seen, stage_->scene, stage_->camera));
            manifest_.add(std::move(pending_->line));
            pending_.reset();
        }
        if (manifest_.has(index, files(index))) {
            ++result_.views;
            return true;
        }
        PixelHits seen;
        if (!arguments_.layers.empty()) {
            seen =
                pixel_hits(stage_->scene, stage_->camera, stage_->size.width, stage_->size.height);
            write_layers(arguments_, folder_, number(index), stage_->scene, stage_->camera, seen,
                         masks_);
        }
        if (!shared_.is_metered) {
            meter();
            image = pose(index);
        }
        image =
            completed_for_screens(std::move(image), asked_, *stage_, denoiser_, shared_, console_);
        std::optional<PartKeeper> no_part;
        const std::optional<JobImage> done =
            render_view(image, *stage_, no_part,
                        {console_, interrupt_, nullptr, denoiser_ ? &*denoiser_ : nullptr, {}});
        if (!done || done->stopped) {
            std::error_code ignored;
            fs::remove(image_file(index), ignored);  // it has too few samples
            return false;
        }
        ordered_json line{{"model", model_.name},           {"view", index},
                          {"file", model_.file.string()},   {"seed", image.options.sampling.seed},
                          {"spp", done->samples_per_pixel}, {"files", files(index)},
                          {"seconds", seconds_since(start)}};
        if (!arguments_.environments.empty()) {
            line["env"] = *asked_.environment;
        }
        ++result_.views;
        ++result_.rendered;
        if (arguments_.has(DatasetLayer::flow) && index + 1 < views_.size()) {
            pending_ = Pending{.index = index, .seen = std::move(seen), .line = std::move(line)};
        } else {
            manifest_.add(std::move(line));
        }
        return true;
    }

    [[nodiscard]] PoseRecord record(std::size_t index, const RenderArguments& image) const
    {
        PoseRecord result;
        result.file = image_file(index).filename().string();
        result.view = {stage_->camera, stage_->size};
        if (arguments_.has(DatasetLayer::depth)) {
            result.depth = number(index) + ".depth.png";
        }
        if (arguments_.has(DatasetLayer::mask)) {
            result.mask = number(index) + ".object.png";
        }
        if (asked_.sequence && asked_.sequence->frames && asked_.sequence->orbit == 0) {
            result.time = image.scene.time;
        }
        return result;
    }

    void finish()
    {
        write_text(folder_ / "transforms.json",
                   poses_text(records_, stage_->scene.description().origin));
        ordered_json line{
            {"model", model_.name}, {"file", model_.file.string()}, {"views", views_.size()}};
        if (!warnings_.empty()) {
            line["warnings"] = warnings_;
        }
        manifest_.add(std::move(line));
    }

    const DatasetArguments& arguments_;
    const DatasetModel& model_;
    const ModelProgress& progress_;
    Interrupt& interrupt_;
    RenderArguments asked_;
    fs::path folder_;
    ModelManifest manifest_;
    Console console_;  // shows nothing
    std::optional<PreparedScene> stage_;
    std::optional<double> time_;  // in the animation, of the stage
    std::optional<Scene> still_;  // before its environment was turned
    std::optional<Viewpoint> first_;
    std::optional<io::Denoiser> denoiser_;
    SharedByViews shared_;
    std::vector<View> views_;
    std::vector<IdNumbers> masks_;
    std::vector<PoseRecord> records_;
    std::optional<Pending> pending_;
    std::vector<std::string> warnings_;
    ModelResult result_;
};

}  // namespace

std::vector<PosedCamera> posed_cameras(const DatasetArguments& arguments, const Scene& scene,
                                       const std::string& model)
{
    const RenderArguments& asked = arguments.render;
    std::vector<PosedCamera> views;
    if (arguments.poses) {
        views = read_poses(*arguments.poses, asked.size, scene.description().origin);
    } else {
        CameraDesc camera;
        constexpr float default_fov = 0.6981317f;  // 40 degrees, as `frame_scene`
        camera.vertical_fov = asked.view.vertical_fov.value_or(default_fov);
        const Size size = asked.size.value_or(default_view_size);
        const Bounds& bounds = scene.bounds();
        for (CameraDesc& drawn : drawn_cameras(arguments.views, camera, bounds.min, bounds.max,
                                               size, asked.options.sampling.seed, model)) {
            views.push_back({std::move(drawn), size});
        }
    }
    for (PosedCamera& view : views) {
        view.camera = with_lens(asked.lens, std::move(view.camera), scene, view.size);
    }
    return views;
}

ModelResult render_model(const DatasetArguments& arguments, const DatasetModel& model,
                         const ModelProgress& progress, Interrupt& interrupt)
{
    return ModelRender(arguments, model, progress, interrupt).run();
}

void record_failure(const DatasetArguments& arguments, const DatasetModel& model, int exit_code,
                    const std::string& message)
{
    append_line(arguments.folder / model.name, {{"model", model.name},
                                                {"file", model.file.string()},
                                                {"error", message},
                                                {"code", exit_code}});
}

}  // namespace bdpt::job
