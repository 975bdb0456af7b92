#pragma once

#include <bdpt/scene.h>
#include <bdpt/tools/pixel_hits.h>

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/dataset_arguments.h"
#include "dataset/dataset_views.h"

namespace bdpt::job {

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

}  // namespace bdpt::job
