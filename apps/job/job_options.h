#pragma once

#include <bdpt/job.h>

#include <vector>

#include "options/option_list.h"
#include "options/render_arguments.h"

namespace bdpt::job {

/// The options of `bdpt render`, and the request that they store into.
class JobOptions {
public:
    /// Gives the options the texts of `settings`.
    explicit JobOptions(const std::vector<JobSetting>& settings);
    JobOptions(const JobOptions&) = delete;
    JobOptions& operator=(const JobOptions&) = delete;

    [[nodiscard]] app::OptionList& list() { return list_; }
    [[nodiscard]] const app::RenderRequest& request() const { return request_; }
    /// Returns the options that have a value.
    [[nodiscard]] std::vector<JobSetting> settings() const;

private:
    app::RenderRequest request_;
    app::OptionList list_;
};

}  // namespace bdpt::job
