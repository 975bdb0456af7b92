#include "plan/plan_split.h"

#include <algorithm>
#include <cmath>

#include "plan/planned_files.h"
#include "plan/sample_split.h"

namespace bdpt::app {
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
