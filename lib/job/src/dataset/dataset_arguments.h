#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/option_list.h"
#include "options/render_arguments.h"
#include "options/value_types.h"

namespace bdpt::job {

/// Layers of a data set's views, each in files of its own; but for the image, all are those of the
/// surface in the middle of each pixel (`PixelHits`).
enum class DatasetLayer : std::uint8_t {
    depth,          ///< distance along the camera's axis [m]
    distance,       ///< distance from the camera [m]
    normal,         ///< shading normal in the world
    camera_normal,  ///< shading normal in the axes of the camera
    uv,             ///< TEXCOORD_0
    position,       ///< in the coordinates of the file [m]
    mask,           ///< integers of object, instance and material
    flow,           ///< motion to the next view [pixels]
};

/// Closed interval of numbers; a single one if both are equal.
struct NumberRange {
    double low = 0.0;
    double high = 0.0;
};

/// Directions from a model to its cameras [rad].
struct ViewRange {
    NumberRange azimuth;    ///< as in `ViewDirection`
    NumberRange elevation;  ///< in [-pi/2, pi/2]
};

/// How the cameras of a model are drawn.
struct ViewDraw {
    std::int64_t count = 24;
    std::optional<ViewRange> range{};  ///< none: spread evenly over the whole sphere
    /// Distance from the middle of the model, over that at which its bounding sphere just fits.
    NumberRange distance{1.0, 1.0};
    std::optional<NumberRange> vertical_fov{};  ///< [rad]; none: that of --fov, else 40 degrees
};

/// One of several processes or machines that share the models.
struct Share {
    std::int64_t index = 0;
    std::int64_t count = 1;
};

/// Whether each model is rendered by a process of its own.
enum class Isolation : std::uint8_t { automatic, on, off };

/// Treatment of views that are there, but of other options or of another model.
enum class ExistingViews : std::uint8_t { refuse, replace };

/// Arguments of `bdpt dataset`.
struct DatasetArguments {
    RenderArguments render{};  ///< of each view; without scene and outputs
    std::vector<std::filesystem::path> models{};
    std::filesystem::path folder{};
    std::string image_type = "png";
    std::vector<DatasetLayer> layers{};
    ViewDraw views{};
    std::optional<std::filesystem::path> poses{};       ///< file of poses in place of draws
    std::vector<std::filesystem::path> environments{};  ///< of which each model draws one
    std::optional<std::filesystem::path> coco{};
    std::optional<std::filesystem::path> root{};  ///< models are named by their paths from here
    Isolation isolation = Isolation::automatic;
    std::optional<double> model_seconds{};  ///< limit for each model [s]
    Share share{};
    ExistingViews existing = ExistingViews::refuse;
    std::vector<std::string> words{};      ///< of the process of a model, without the model
    std::vector<std::string> key_words{};  ///< those that a view depends on

    [[nodiscard]] bool has(DatasetLayer layer) const;
};

/// Options of `bdpt dataset`, as given.
struct DatasetRequest {
    RenderRequest render{};
    DatasetArguments arguments{};
    std::vector<std::string> models{};  ///< files, or patterns of files
};

/// Adds the options of `bdpt dataset`.
void add_dataset_options(OptionList& options, DatasetRequest& request);

/// Checks and converts the options; finds the files of patterns. Throws `OptionError`, and `Error`
/// (not_found) for a pattern without files.
[[nodiscard]] DatasetArguments checked(const DatasetRequest& request, const OptionList& options);

}  // namespace bdpt::job
