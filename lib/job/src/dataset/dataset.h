#pragma once

#include <bdpt/part/content_hash.h>
#include <bdpt/scene.h>
#include <bdpt/tools/pixel_hits.h>
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/dataset_arguments.h"
#include "messages/console.h"
#include "options/value_types.h"

namespace bdpt::job {

/// A model of a data set.
struct DatasetModel {
    std::filesystem::path file;
    std::string name;  ///< of its folder: unique, may have slashes
};

/// Size of images without --size [pixels].
inline constexpr Size default_view_size{512, 512};

// Cameras.

/// Random numbers of a model: they depend on the seed, the model's name and the number of the view
/// alone, not on other models, machines or the order of views.
class ModelDraw {
public:
    ModelDraw(std::uint64_t seed, std::string_view model, std::uint64_t view);
    /// Returns the next number, in [0, 1).
    [[nodiscard]] double next();
    [[nodiscard]] double next(const NumberRange& interval);

private:
    std::uint64_t key_;
    std::uint64_t count_ = 0;
};

/// Returns the environment that a model draws. `environments` is not empty.
[[nodiscard]] const std::filesystem::path& drawn_environment(
    std::span<const std::filesystem::path> environments, std::uint64_t seed,
    std::string_view model);

/// Returns the cameras of a model with these bounds, by `draw`, in images of `size`. `camera` has
/// the default field of view. On the whole sphere they form a spherical Fibonacci lattice [Gonzalez
/// 2010, "Measurement of areas on a sphere using Fibonacci and latitude-longitude lattices"] in a
/// random rotation.
[[nodiscard]] std::vector<CameraDesc> drawn_cameras(const ViewDraw& draw, const CameraDesc& camera,
                                                    Vec3 min, Vec3 max, const Size& size,
                                                    std::uint64_t seed, std::string_view model);

/// A camera and its image.
struct PosedCamera {
    CameraDesc camera;
    Size size;
};

/// A view in a file of poses.
struct PoseRecord {
    std::string file;  ///< of the image, relative to that of the poses
    std::optional<std::string> depth{};
    std::optional<std::string> mask{};
    std::optional<double> time{};  ///< in the animation [s]
    PosedCamera view;              ///< in the world
};

/// Returns the text of a file of poses, as nerfstudio reads it: OpenGL's axes from camera to world
/// ("transform_matrix") in the coordinates of the model's file, and OpenCV's from world to camera
/// ("opencv"). `origin` is that of the world.
[[nodiscard]] std::string poses_text(std::span<const PoseRecord> records, const DVec3& origin);

/// Reads cameras from a file of poses. Without a size in the file, images have `size`; with both,
/// the cameras are scaled to `size`. Throws `Error`: not_found, invalid_input for a matrix that is
/// no rigid motion and for a size of another shape.
[[nodiscard]] std::vector<PosedCamera> read_poses(const std::filesystem::path& file,
                                                  const std::optional<Size>& size,
                                                  const DVec3& origin);

/// Returns the cameras of a model: those of --poses, else drawn ones. Throws `Error` as
/// `read_poses` and `with_lens`.
[[nodiscard]] std::vector<PosedCamera> posed_cameras(const DatasetArguments& arguments,
                                                     const Scene& scene, const std::string& model);

// Files of a view.

/// Names of the kinds of masks, in the order of `id_kinds`: "object", "instance", "material".
[[nodiscard]] std::string_view mask_name(IdKind kind);

/// Returns the names of all files of a view, relative to the model's folder; the image is the
/// first. The last view of a model has no flow.
[[nodiscard]] std::vector<std::string> view_files(const DatasetArguments& arguments,
                                                  std::string_view number, bool is_last);

/// Values of a layer of floats.
struct LayerValues {
    std::string_view name;      ///< as in --aov and in names of files
    std::string_view channels;  ///< one letter each, as in .exr files
    std::vector<float> values;  ///< row by row, channels interleaved
};

/// Returns the layers of floats that were asked for, but flow.
[[nodiscard]] std::vector<LayerValues> float_layers(const DatasetArguments& arguments,
                                                    const Scene& scene, const CameraDesc& camera,
                                                    const PixelHits& seen);

/// Writes the layers of a view that need no other view into `folder`. `masks` are the integers of
/// the scene's things, in the order of `id_kinds`; empty without masks. Throws `Error` (output).
void write_layers(const DatasetArguments& arguments, const std::filesystem::path& folder,
                  std::string_view number, const Scene& scene, const CameraDesc& camera,
                  const PixelHits& seen, std::span<const IdNumbers> masks);

/// Writes the flow from a view to the next one. Throws `Error` (output).
void write_flow(const std::filesystem::path& folder, std::string_view number, const PixelHits& seen,
                std::span<const PixelFlow> flow);

/// Returns the integers of masks, in the order of `id_kinds`; empty if none were asked for. Throws
/// `Error` (unsupported) if the names of a kind do not fit 16 bits.
[[nodiscard]] std::vector<IdNumbers> mask_numbers(const DatasetArguments& arguments,
                                                  const Scene& scene);

/// Writes masks.json: the names of the integers. Throws `Error` (output).
void write_mask_names(const std::filesystem::path& folder, std::span<const IdNumbers> masks);

/// A view whose instances are annotated.
struct AnnotatedView {
    std::string image;                 ///< name of its file in the data set
    std::filesystem::path instances;   ///< file of its mask of instances
    std::filesystem::path objects;     ///< file of its mask of objects
    std::filesystem::path mask_names;  ///< masks.json of its model
};

/// Writes the instances of all views as COCO's annotations [Lin et al. 2014, "Microsoft COCO";
/// cocodataset.org, "Data format"]: boxes, areas, and masks as uncompressed run lengths; categories
/// are objects' names. Throws `Error`: invalid_input for a mask that is not there, output.
void write_coco(const std::filesystem::path& file, std::span<const AnnotatedView> views);

/// The lines about one model, in manifest.jsonl of its folder: one for each view whose files are
/// all there, one when all views are, and one for each failure. Lines are appended, so that a
/// process that is killed leaves all of them but the last, which may be cut off.
class ModelManifest {
public:
    /// Reads the lines that are there. `key` is the hash of all that the views depend on.
    ModelManifest(std::filesystem::path folder, const ContentHash& key);

    /// Tests whether all lines are of the same key.
    [[nodiscard]] bool is_ours() const { return is_ours_; }
    /// Tests whether all views and their poses are there.
    [[nodiscard]] bool is_complete() const { return complete_.has_value(); }
    /// Returns the number of views of a complete model.
    [[nodiscard]] std::size_t count() const { return complete_.value_or(0); }
    /// Tests whether a view is there, with all its `files`.
    [[nodiscard]] bool has(std::size_t view, const std::vector<std::string>& files) const;

    /// Removes all views that the lines name, and the lines.
    void clear();
    /// Appends a view, whose number is "view", or that all views are there. Throws `Error`
    /// (output).
    void add(nlohmann::ordered_json line);

private:
    std::filesystem::path folder_;
    std::string key_;
    bool is_ours_ = true;
    std::optional<std::size_t> complete_{};
    std::map<std::size_t, std::vector<std::string>> views_;  // files by number
    std::vector<std::string> files_;                         // of all lines
};

/// Appends `line` to the manifest in `folder`, which is created if necessary. Throws `Error`
/// (output).
void append_line(const std::filesystem::path& folder, const nlohmann::ordered_json& line);

/// Returns the lines of the manifest in `folder` that are to be kept: one for each view, the last
/// of the others, in the order of views. Empty if there is none.
[[nodiscard]] std::vector<nlohmann::ordered_json> final_lines(const std::filesystem::path& folder);

/// Returns the names of the files of a line, the image first; empty if it has none.
[[nodiscard]] std::vector<std::string> files_of(const nlohmann::ordered_json& line);

/// Environment variable by which the process of a model knows the one that started it.
inline constexpr const char* dataset_parent = "BDPT_DATASET_PARENT";

/// How a process ended.
struct ModelEnd {
    int exit_code = 0;    ///< a signal's is 128 and its number
    std::string message;  ///< its last error; empty: none
    bool timed_out = false;
};

/// This program in a process of its own, which renders one model. Its output is read without
/// waiting, so that several run side by side.
class ModelProcess {
public:
    /// Starts `bdpt dataset` with these arguments. Throws `Error` (out_of_memory) if that fails.
    explicit ModelProcess(const std::vector<std::string>& arguments);
    /// Kills the process if it still runs.
    ~ModelProcess();
    ModelProcess(ModelProcess&& other) noexcept;
    ModelProcess& operator=(ModelProcess&&) = delete;

    /// Returns the lines that it wrote since the last call.
    [[nodiscard]] std::vector<std::string> new_lines();
    /// Returns how it ended; none: it still runs. It is killed if it runs longer than `limit` [s].
    [[nodiscard]] std::optional<ModelEnd> end(const std::optional<double>& limit);
    /// Asks it to stop.
    void stop() const;
    /// Returns descriptors that become readable when there is something new.
    [[nodiscard]] std::vector<int> descriptors() const;
    [[nodiscard]] double seconds() const;

private:
    pid_t id_ = -1;
    int output_ = -1;
    int errors_ = -1;
    std::string line_;     // begun, not ended
    std::string message_;  // all that it wrote to its standard error
    bool killed_ = false;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Waits until one of `descriptors` is readable, or for a short time.
void wait_for_any(const std::vector<int>& descriptors);

/// Lets the kernel end this process when that of `dataset_parent` ends. Returns false if there is
/// none.
bool end_with_dataset();

// Renders.

/// What became of a model.
struct ModelResult {
    std::size_t views = 0;     ///< that are there
    std::size_t rendered = 0;  ///< of these, those rendered now
    double seconds = 0.0;
    bool stopped = false;  ///< a stop was requested before all views were there
};

/// Called while a model is rendered.
struct ModelProgress {
    std::function<void()> loaded;
    std::function<void(std::size_t done, std::size_t all)> viewed;
};

/// Renders the missing views of a model into its folder, with their poses; each view that is there
/// is a line of its manifest. Throws `Error`: of loading, and output if the folder has views of
/// other options.
ModelResult render_model(const DatasetArguments& arguments, const DatasetModel& model,
                         const ModelProgress& progress, Interrupt& interrupt);

/// Adds a failure of `model` to its manifest.
void record_failure(const DatasetArguments& arguments, const DatasetModel& model, int exit_code,
                    const std::string& message);

/// Called with the exit code and the message of a model that failed.
using OnFailure = std::function<void(int exit_code, const std::string& message)>;

/// Renders all models of this share: `bdpt dataset`. Returns the exit code: 0, or that of the first
/// model that failed. Throws `Error` for what concerns all models.
[[nodiscard]] int run_dataset(const DatasetArguments& arguments, Console& console,
                              Interrupt& interrupt, const OnFailure& on_failure);

}  // namespace bdpt::job
