#include "options/groups/light_sampling_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "options/arguments.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

constexpr std::array<std::pair<const char*, EnvironmentSampling>, 2> environment_samplings{
    {{"plain", EnvironmentSampling::plain}, {"compensated", EnvironmentSampling::compensated}}};

constexpr std::array<std::pair<const char*, LightSampling>, 3> light_samplings{
    {{"auto", LightSampling::automatic},
     {"power", LightSampling::power},
     {"tree", LightSampling::tree}}};

/// The value beside `name`, which the parser has found in the table.
template <typename Table>
auto value_of(const Table& table, const std::string& name)
{
    return std::find_if(table.begin(), table.end(),
                        [&](const auto& entry) { return entry.first == name; })
        ->second;
}

template <typename Table, typename Value>
const char* name_of(const Table& table, Value value)
{
    return std::find_if(table.begin(), table.end(),
                        [&](const auto& entry) { return entry.second == value; })
        ->first;
}

template <typename Table>
std::vector<std::string> names_of(const Table& table)
{
    std::vector<std::string> names;
    for (const auto& entry : table) {
        names.emplace_back(entry.first);
    }
    return names;
}

}  // namespace

void add_light_sampling_options(CLI::App& command, LightSamplingWords& words, const char* group)
{
    const auto add_choice = [&](const char* name, std::string& value,
                                const std::vector<std::string>& values, const std::string& help) {
        command.add_option(name, value, help)
            ->check(one_of(values))
            ->type_name(fmt::format("{}", fmt::join(values, "|")))
            ->group(group);
    };
    add_choice("--env-sampling", words.environments, names_of(environment_samplings),
               "Light sampling of environments: compensated (default; MIS compensation, leaves "
               "uniform light to BSDF sampling) or plain");
    add_choice("--light-sampling", words.lights, names_of(light_samplings),
               "Choice of one light: power (by emitted power), tree (light tree: by estimated "
               "contribution to the point), auto (default: tree for many lights, and for lamps "
               "beside the sun or an environment)");
    add_light_samples_option(command, words, group);
}

void add_light_samples_option(CLI::App& command, LightSamplingWords& words, const char* group)
{
    command
        .add_option("--light-samples", words.samples,
                    "Light samples at each vertex of a camera path (all integrators but lt), which "
                    "share the weight of one: less noise in direct light, more time. Default: 1")
        ->check(whole_number(1, 1024))
        ->type_name("N")
        ->group(group);
}

SamplingOptions with_light_sampling(const LightSamplingWords& words, const std::string& integrator,
                                    SamplingOptions options)
{
    if (words.samples && integrator == "lt") {
        reject("--light-samples", fmt::format("{}", *words.samples),
               "an integrator that samples lights from camera paths, not lt");
    }
    options.environment = value_of(environment_samplings, words.environments);
    options.lights = value_of(light_samplings, words.lights);
    options.light_samples = words.samples.value_or(options.light_samples);
    return options;
}

nlohmann::ordered_json light_sampling_json(const SamplingOptions& options)
{
    return {{"environment_sampling", name_of(environment_samplings, options.environment)},
            {"light_sampling", name_of(light_samplings, options.lights)},
            {"light_samples", options.light_samples}};
}

}  // namespace bdpt::app
