#pragma once

#include <bdpt/scene.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dataset/dataset_arguments.h"
#include "dataset/dataset_views.h"
#include "messages/console.h"

namespace bdpt::job {

/// A model of a data set.
struct DatasetModel {
    std::filesystem::path file;
    std::string name;  ///< of its folder: unique, may have slashes
};

/// Returns the models of this share, sorted by name. Throws `Error` (usage) for two models of the
/// same name, and for one that is not below --root.
[[nodiscard]] std::vector<DatasetModel> dataset_models(const DatasetArguments& arguments);

/// Size of images without --size [pixels].
inline constexpr Size default_view_size{512, 512};

/// Returns the cameras of a model: those of --poses, else drawn ones. Throws `Error` as
/// `read_poses` and `with_lens`.
[[nodiscard]] std::vector<PosedCamera> posed_cameras(const DatasetArguments& arguments,
                                                     const Scene& scene, const std::string& model);

/// What became of a model.
struct ModelResult {
    std::size_t views = 0;     ///< that are there
    std::size_t rendered = 0;  ///< of these, those rendered now
    double seconds = 0.0;
    bool stopped = false;  ///< a stop was requested before all views were there
};

/// What a model's render tells while it runs.
class ModelProgress {
public:
    ModelProgress() = default;
    virtual ~ModelProgress() = default;
    ModelProgress(const ModelProgress&) = delete;
    ModelProgress& operator=(const ModelProgress&) = delete;
    virtual void loaded() {}
    virtual void viewed(std::size_t /*done*/, std::size_t /*all*/) {}
};

/// Renders the missing views of a model into its folder, with their poses; each view that is there
/// is a line of its manifest. Throws `Error`: of loading, and output if the folder has views of
/// other options.
ModelResult render_model(const DatasetArguments& arguments, const DatasetModel& model,
                         ModelProgress& progress, Interrupt& interrupt);

/// Adds a failure of `model` to its manifest.
void record_failure(const DatasetArguments& arguments, const DatasetModel& model, int exit_code,
                    const std::string& message);

/// Writes what belongs to all models: manifest.jsonl, a line for each view and failure in the order
/// of models and views, and the file of --coco. Throws `Error`.
void write_summary(const DatasetArguments& arguments, const std::vector<DatasetModel>& models);

/// Called with the exit code and the message of a model that failed.
using OnFailure = std::function<void(int exit_code, const std::string& message)>;

/// Renders all models of this share: `bdpt dataset`. Returns the exit code: 0, or that of the first
/// model that failed. Throws `Error` for what concerns all models.
[[nodiscard]] int run_dataset(const DatasetArguments& arguments, Console& console,
                              Interrupt& interrupt, const OnFailure& on_failure);

}  // namespace bdpt::job
