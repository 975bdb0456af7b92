#include "plan/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "options/values/file_pattern.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

/// A run of consecutive numbers.
struct Run {
    std::size_t first = 0;
    std::size_t last = 0;
};

std::vector<Run> find_runs(const std::vector<std::size_t>& numbers)
{
    std::vector<Run> runs;
    for (const std::size_t number : numbers) {
        if (!runs.empty() && runs.back().last + 1 == number) {
            runs.back().last = number;
        } else {
            runs.push_back({.first = number, .last = number});
        }
    }
    return runs;
}

/// Returns "frame 3", "camera left" or "frame 3 of camera left".
std::string image_text(const PlanImage& image)
{
    const std::string camera = image.camera ? "camera " + one_line(*image.camera) : "";
    if (!image.frame) {
        return camera;
    }
    return fmt::format("frame {}{}{}", *image.frame, camera.empty() ? "" : " of ", camera);
}

}  // namespace

SampleSet collect_samples(const Plan& plan)
{
    // Sorted, so that each range is added at the end.
    std::vector<SampleRange> ranges;
    for (const PlanTask& task : plan.tasks) {
        ranges.push_back(task.samples);
    }
    std::sort(ranges.begin(), ranges.end(),
              [](const SampleRange& a, const SampleRange& b) { return a.begin < b.begin; });
    SampleSet result;
    for (const SampleRange& range : ranges) {
        result.add(range);
    }
    return result;
}

bool is_sequence(const Plan& plan)
{
    return plan.images.front().seed.has_value();
}

std::vector<std::string> collect_cameras(const Plan& plan)
{
    std::vector<std::string> cameras;
    for (const PlanImage& image : plan.images) {
        if (image.camera && image.frame == plan.images.front().frame) {
            cameras.push_back(*image.camera);
        }
    }
    return cameras;
}

fs::path expand_pattern(const fs::path& pattern, const PlanImage& image)
{
    const fs::path file = image.frame ? with_number(pattern, *image.frame) : pattern;
    return image.camera ? with_camera(file, *image.camera) : file;
}

std::vector<std::vector<fs::path>> parts_by_image(const Plan& plan)
{
    std::vector<std::vector<fs::path>> parts(plan.images.size());
    for (const PlanTask& task : plan.tasks) {
        for (std::size_t i = 0; i < task.images; ++i) {
            const std::size_t image = task.first_image + i;
            parts[image].push_back(expand_pattern(task.part, plan.images[image]));
        }
    }
    return parts;
}

std::vector<std::size_t> tasks_for(const Plan& plan, const std::vector<SampleSet>& missing)
{
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
        const PlanTask& task = plan.tasks[i];
        const auto begin = missing.begin() + static_cast<std::ptrdiff_t>(task.first_image);
        const SampleSet own(task.samples);
        if (std::any_of(begin, begin + static_cast<std::ptrdiff_t>(task.images),
                        [&](const SampleSet& samples) { return !samples.overlap(own).empty(); })) {
            result.push_back(i);
        }
    }
    return result;
}

ImageLabel make_label(const Plan& plan, std::size_t image)
{
    return {.frame = plan.images[image].frame,
            .camera = plan.images[image].camera,
            .index = image,
            .count = plan.images.size()};
}

std::string images_text(const Plan& plan, const std::vector<std::size_t>& images)
{
    constexpr std::size_t max_runs = 8;
    const std::vector<Run> runs = find_runs(images);
    std::string text;
    for (std::size_t i = 0; i < std::min(runs.size(), max_runs); ++i) {
        text += (text.empty() ? "" : ", ") + image_text(plan.images[runs[i].first]);
        if (runs[i].first != runs[i].last) {
            text += " to " + image_text(plan.images[runs[i].last]);
        }
    }
    return runs.size() > max_runs ? text + ", ..." : text;
}

std::string numbers_text(const std::vector<std::size_t>& numbers)
{
    std::string result;
    for (const Run& run : find_runs(numbers)) {
        result += result.empty() ? "" : ",";
        result += run.first == run.last ? fmt::format("{}", run.first)
                                        : fmt::format("{}-{}", run.first, run.last);
    }
    return result;
}

}  // namespace bdpt::app
