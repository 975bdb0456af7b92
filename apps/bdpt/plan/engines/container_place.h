#pragma once

#include <filesystem>
#include <string>

#include "plan/plan.h"

namespace bdpt::app {

/// Paths of a plan in a container that has the planned files in /data.
struct ContainerPlace {
    std::filesystem::path shared;   ///< host folder mounted at /data
    std::filesystem::path working;  ///< container folder with plan.json
};

/// Returns the smallest folder that contains the plan's folder and all its files named by relative
/// paths. `folder` is that of the plan, absolute.
[[nodiscard]] ContainerPlace container_place(const Plan& plan, const std::filesystem::path& folder);

/// Returns a job name that Kubernetes and AWS accept: "bdpt-" and the small letters and digits of
/// the folder's name.
[[nodiscard]] std::string job_name(const std::filesystem::path& folder);

}  // namespace bdpt::app
