#pragma once

#include <filesystem>
#include <string>

#include "plan/plan.h"

namespace bdpt::app {

/// How a plan looks from within a container that has the planned files in /data.
struct ContainerPlace {
    std::filesystem::path shared;   ///< folder here that /data is there
    std::filesystem::path working;  ///< folder there that has plan.json
};

/// The smallest folder that has the plan's folder and all files of it that are named by relative
/// paths. `folder` is that of the plan, absolute.
[[nodiscard]] ContainerPlace container_place(const Plan& plan, const std::filesystem::path& folder);

/// A name for a job that Kubernetes and AWS accept: "bdpt-" and what the folder's name has of small
/// letters and digits.
[[nodiscard]] std::string job_name(const std::filesystem::path& folder);

}  // namespace bdpt::app
