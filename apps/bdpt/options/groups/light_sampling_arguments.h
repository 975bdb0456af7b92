#pragma once

#include <bdpt/render_options.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace bdpt::app {

/// What words say about next-event estimation, as they were given.
struct LightSamplingWords {
    std::string environments = "compensated";
    std::string lights = "auto";
    std::optional<int> samples{};
};

/// Describes --env-sampling, --light-sampling and --light-samples to the parser.
void add_light_sampling_options(CLI::App& command, LightSamplingWords& words, const char* group);

/// Describes --light-samples alone.
void add_light_samples_option(CLI::App& command, LightSamplingWords& words, const char* group);

/// `options` with what `words` say. Throws `OptionError` for what `integrator` cannot heed.
[[nodiscard]] SamplingOptions with_light_sampling(const LightSamplingWords& words,
                                                  const std::string& integrator,
                                                  SamplingOptions options);

/// The options as members of the settings that are written into images.
[[nodiscard]] nlohmann::ordered_json light_sampling_json(const SamplingOptions& options);

}  // namespace bdpt::app
