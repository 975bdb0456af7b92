#pragma once

#include <bdpt/render_options.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plan/plan.h"

namespace bdpt::app {

/// Returns `count` tasks that render `samples` of all images of `plan`, image by image. With fewer
/// tasks than images, a task takes several consecutive images; else the samples of each image are
/// split into ranges of multiples of `least` samples. `count` is in [1, images * samples / least].
[[nodiscard]] std::vector<PlanTask> split_plan(const Plan& plan, SampleRange samples,
                                               std::int64_t count, std::int64_t least = 1);

/// Returns the number of tasks for `images` images that take about `seconds` each. A sample of an
/// image takes `seconds_per_sample`, and an image `seconds_to_start`. Ranges have at least `least`
/// samples.
[[nodiscard]] std::int64_t tasks_of_time(std::size_t images, SampleRange samples, double seconds,
                                         double seconds_per_sample, double seconds_to_start,
                                         std::int64_t least = 1);

}  // namespace bdpt::app
