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
    std::optional<int> frame{};           ///< of an animation or a turntable
    std::optional<std::string> camera{};  ///< its name or index, if all cameras make images
    std::optional<std::uint64_t> seed{};  ///< of a plan of several images
    [[nodiscard]] bool operator==(const PlanImage&) const = default;
};

/// What one process of a planned render does.
struct PlanTask {
    std::size_t first_image = 0;  ///< index in the plan
    std::size_t images = 1;       ///< that it renders, one after the other
    SampleRange samples;          ///< of each of them
    std::filesystem::path part;   ///< the file that it writes; with #### and {camera} for several
    [[nodiscard]] bool operator==(const PlanTask&) const = default;
};

/// A render that is shared by several processes. Paths are absolute, or relative to the folder of
/// the plan's file: so a folder that holds all of it may be somewhere else for each of them.
struct Plan {
    std::filesystem::path scene;
    std::optional<std::filesystem::path> environment{};  ///< the file of --env
    std::optional<std::filesystem::path> volume{};       ///< the file of --volume
    std::optional<std::filesystem::path> rates{};  ///< the file of --rates, in the plan's folder
    std::vector<std::string> render_options{};     ///< further words of bdpt render, alike for all
    std::vector<std::string> merge_options{};      ///< words of bdpt merge
    std::vector<std::filesystem::path> outputs{};  ///< with #### and {camera} for several
    std::optional<std::filesystem::path> strategies{};  ///< .exr for the images of strategies
    std::vector<PlanImage> images{PlanImage{}};         ///< in the order of `bdpt render`
    std::vector<PlanTask> tasks{};
    std::vector<std::filesystem::path> engine_files{};  ///< what starts the tasks
    Identity identity{};  ///< that each task must find; of several images what they have in common
    Identity files{};     ///< of several images: what is in the files that they are made of
    [[nodiscard]] bool operator==(const Plan&) const = default;
};

/// All samples that the tasks render of an image.
[[nodiscard]] SampleSet samples_of(const Plan& plan);

/// Was the plan made for the images of a sequence, be it of one image?
[[nodiscard]] bool is_sequence(const Plan& plan);

/// The cameras of a plan of all cameras, in their order; else none.
[[nodiscard]] std::vector<std::string> cameras_of(const Plan& plan);

/// The file that `pattern` means for `image`.
[[nodiscard]] std::filesystem::path file_of(const std::filesystem::path& pattern,
                                            const PlanImage& image);

/// How messages call image `image`.
[[nodiscard]] ImageLabel label_of(const Plan& plan, std::size_t image);

/// "frame 3, frame 5 to frame 9" of indices of images in ascending order.
[[nodiscard]] std::string images_text(const Plan& plan, const std::vector<std::size_t>& images);

/// The files that tasks make of each image.
[[nodiscard]] std::vector<std::vector<std::filesystem::path>> parts_by_image(const Plan& plan);

/// The tasks that render some of the samples that images miss: `missing` has those of each image of
/// the plan. In ascending order.
[[nodiscard]] std::vector<std::size_t> tasks_for(const Plan& plan,
                                                 const std::vector<SampleSet>& missing);

/// "0-2,5" of numbers in ascending order.
[[nodiscard]] std::string numbers_text(const std::vector<std::size_t>& numbers);

}  // namespace bdpt::app
