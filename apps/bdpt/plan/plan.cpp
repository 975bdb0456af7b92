#include "plan/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "options/output_files.h"
#include "plan/plan_file.h"
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

namespace {

constexpr std::int64_t best_unit = 64;  // samples

std::int64_t divided_up(std::int64_t a, std::int64_t b)
{
    return a / b + (a % b != 0 ? 1 : 0);
}

}  // namespace

std::vector<SampleRange> split_samples(SampleRange samples, std::int64_t parts, std::int64_t least)
{
    std::int64_t unit = best_unit;
    const auto blocks = [&] { return divided_up(samples.end, unit) - samples.begin / unit; };
    while (blocks() < parts && unit > least) {
        unit /= 2;
    }
    const std::int64_t first = samples.begin / unit;
    const auto boundary = [&](std::int64_t part) {
        return std::clamp((first + part * blocks() / parts) * unit, samples.begin, samples.end);
    };
    std::vector<SampleRange> result;
    for (std::int64_t part = 0; part < parts; ++part) {
        result.push_back({.begin = boundary(part), .end = boundary(part + 1)});
    }
    return result;
}

std::int64_t parts_of_time(SampleRange samples, double seconds, double seconds_per_sample,
                           double seconds_to_start, std::int64_t least)
{
    const std::int64_t total = samples.end - samples.begin;
    const double fitting = std::floor((seconds - seconds_to_start) / seconds_per_sample);
    auto count = static_cast<std::int64_t>(std::clamp(fitting, 1.0, static_cast<double>(total)));
    count = std::clamp(count, std::min(least, total), total);
    if (count < total) {
        count = count >= best_unit
                    ? count / best_unit * best_unit
                    : static_cast<std::int64_t>(std::bit_floor(static_cast<std::uint64_t>(count)));
    }
    return divided_up(total, count);
}

std::vector<PlanTask> split_plan(const Plan& plan, SampleRange samples, std::int64_t count,
                                 std::int64_t least)
{
    std::vector<PlanTask> tasks;
    const auto images = static_cast<std::int64_t>(plan.images.size());
    const auto add = [&](std::int64_t first, std::int64_t end, SampleRange range) {
        tasks.push_back({.first_image = static_cast<std::size_t>(first),
                         .images = static_cast<std::size_t>(end - first),
                         .samples = range,
                         .part = part_name(plan.images.front(), tasks.size(),
                                           static_cast<std::size_t>(count))});
    };
    for (std::int64_t task = 0; task < count && count <= images; ++task) {
        add(task * images / count, (task + 1) * images / count, samples);
    }
    for (std::int64_t image = 0; image < images && count > images; ++image) {
        const std::int64_t ranges = count / images + (image < count % images ? 1 : 0);
        for (const SampleRange& range : split_samples(samples, ranges, least)) {
            add(image, image + 1, range);
        }
    }
    return tasks;
}

std::int64_t tasks_of_time(std::size_t images, SampleRange samples, double seconds,
                           double seconds_per_sample, double seconds_to_start, std::int64_t least)
{
    const auto count = static_cast<std::int64_t>(images);
    const std::int64_t parts =
        parts_of_time(samples, seconds, seconds_per_sample, seconds_to_start, least);
    if (parts > 1 || count == 1) {
        return parts * count;
    }
    const double one =
        seconds_to_start + seconds_per_sample * static_cast<double>(samples.end - samples.begin);
    const double fitting = std::clamp(std::floor(seconds / one), 1.0, static_cast<double>(count));
    return static_cast<std::int64_t>(std::ceil(static_cast<double>(count) / fitting));
}

}  // namespace bdpt::app
