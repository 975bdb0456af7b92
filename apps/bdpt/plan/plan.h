#pragma once

#include <bdpt/part/identity.h>
#include <bdpt/part/sample_set.h>
#include <bdpt/render_options.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "terminal/console.h"

namespace bdpt::app {

/// One image of a plan.
struct PlanImage {
    std::optional<int> frame{};           ///< frame of an animation or a turntable
    std::optional<std::string> camera{};  ///< name or index, if all cameras are rendered
    std::optional<std::uint64_t> seed{};  ///< for a plan of several images
    [[nodiscard]] bool operator==(const PlanImage&) const = default;
};

/// Work of one process of a planned render.
struct PlanTask {
    std::size_t first_image = 0;  ///< index in the plan
    std::size_t images = 1;       ///< number of images to render, one after the other
    SampleRange samples;          ///< samples of each image
    std::filesystem::path part;  ///< file that it writes; with #### and {camera} for several images
    [[nodiscard]] bool operator==(const PlanTask&) const = default;
};

/// A render that is shared by several processes. Paths are absolute, or relative to the folder of
/// the plan's file, so a folder with all files may be mounted at a different place for each
/// process.
struct Plan {
    std::filesystem::path scene;
    std::optional<std::filesystem::path> environment{};  ///< the file of --env
    std::optional<std::filesystem::path> volume{};       ///< the file of --volume
    std::optional<std::filesystem::path> rates{};  ///< the file of --rates, in the plan's folder
    /// Further words of bdpt render, the same for all tasks.
    std::vector<std::string> render_options{};
    std::vector<std::string> merge_options{};      ///< words of bdpt merge
    std::vector<std::filesystem::path> outputs{};  ///< with #### and {camera} for several images
    std::optional<std::filesystem::path> strategies{};  ///< .exr file of strategy images
    std::vector<PlanImage> images{PlanImage{}};         ///< in the order of `bdpt render`
    std::vector<PlanTask> tasks{};
    std::vector<std::filesystem::path> engine_files{};  ///< files that start the tasks
    Identity identity{};  ///< identity that each task must find; for several images the components
                          ///< they share
    Identity files{};     ///< for several images: contents of the files that they are made of
    [[nodiscard]] bool operator==(const Plan&) const = default;
};

/// Returns all samples that the tasks render of an image.
[[nodiscard]] SampleSet collect_samples(const Plan& plan);

/// Tests whether the plan was made for the images of a sequence, even for a single one.
[[nodiscard]] bool is_sequence(const Plan& plan);

/// Returns the cameras of a plan of all cameras, in their order; else none.
[[nodiscard]] std::vector<std::string> collect_cameras(const Plan& plan);

/// Returns the file of `image` by its `pattern`.
[[nodiscard]] std::filesystem::path expand_pattern(const std::filesystem::path& pattern,
                                                   const PlanImage& image);

/// Returns the label of image `image`, for messages.
[[nodiscard]] ImageLabel make_label(const Plan& plan, std::size_t image);

/// Returns "frame 3, frame 5 to frame 9" for indices of images in ascending order.
[[nodiscard]] std::string images_text(const Plan& plan, const std::vector<std::size_t>& images);

/// Returns the files that the tasks write for each image.
[[nodiscard]] std::vector<std::vector<std::filesystem::path>> parts_by_image(const Plan& plan);

/// Returns the tasks that render some of the missing samples of images, in ascending order:
/// `missing` has those of each image of the plan.
[[nodiscard]] std::vector<std::size_t> tasks_for(const Plan& plan,
                                                 const std::vector<SampleSet>& missing);

/// Returns "0-2,5" for numbers in ascending order.
[[nodiscard]] std::string numbers_text(const std::vector<std::size_t>& numbers);

}  // namespace bdpt::app
