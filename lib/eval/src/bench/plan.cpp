#include "bench/bench_parts.h"

#include <bdpt/error.h>
#include <bdpt/options/option_fields.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace bdpt::eval {
namespace {

using nlohmann::ordered_json;

constexpr const char* samples_member = "equal_time_samples";

/// Returns the settings that all runs in a folder share.
ordered_json plan_settings(const BenchScene& scene, const BenchOptions& options,
                           const std::string& reference)
{
    ordered_json settings = render_settings(scene, options.render);
    settings["threads"] = options.render.system.threads;
    settings["cpu_seconds"] = options.seconds;
    settings["equal_samples"] = options.samples ? ordered_json(*options.samples) : ordered_json();
    settings["reference"] = reference;
    return settings;
}

/// Returns a value as text, without quotes.
std::string shown(const ordered_json& value)
{
    return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Throws the `Error` for a folder with other settings, naming the difference.
void check_same(const ordered_json& ours, const ordered_json& kept,
                const std::filesystem::path& file)
{
    for (const auto& [name, value] : ours.items()) {
        const ordered_json other =
            kept.is_object() ? kept.value(name, ordered_json()) : ordered_json();
        if (other != value) {
            throw Error(ErrorCode::usage, file.string() + ": holds runs with " + name + " " +
                                              shown(other) + ", not " + shown(value) +
                                              "; choose another folder, or delete this one");
        }
    }
}

}  // namespace

Plan::Plan(const BenchScene& scene, const BenchOptions& options, const BenchFiles& files,
           const std::string& reference)
    : file_(files.plan()), json_{{"settings", plan_settings(scene, options, reference)}}
{
    std::optional<ordered_json> kept = read_json(file_);
    if (kept) {
        check_same(json_["settings"], kept->value("settings", ordered_json()), file_);
        json_ = std::move(*kept);
        if (json_.contains(samples_member) && !json_[samples_member].is_object()) {
            throw Error(ErrorCode::invalid_input, file_.string() + ": " + samples_member +
                                                      " is not an object; delete the folder to "
                                                      "start again");
        }
    }
}

bool Plan::complete(const BenchScene& scene, const BenchOptions& options, BenchProgressMeter& meter,
                    const BenchControl& control)
{
    for (const IntegratorKind kind : options.integrators) {
        const double seconds = options.seconds * calibration_share;
        if (known(kind)) {
            meter.skip(seconds);
            continue;
        }
        meter.begin("how many samples " + std::string(to_name(kind)) + " takes", seconds);
        const auto samples =
            samples_in(make_setup(scene, options.render, kind, 0, control), options.seconds);
        if (!samples) {
            return false;
        }
        meter.end();
        json_[samples_member][to_name(kind)] = *samples;
    }
    if (!json_.contains("equal_samples")) {
        json_["equal_samples"] = options.samples.value_or(power_of_two_for_all(options));
    }
    write_json(file_, json_);
    return true;
}

BenchGoals Plan::goals(IntegratorKind kind) const
{
    return {.integrator = kind,
            .equal_time = number(samples_member, std::string(to_name(kind))),
            .equal_samples = number("", "equal_samples")};
}

bool Plan::known(IntegratorKind kind) const
{
    const auto samples = json_.find(samples_member);
    return samples != json_.end() && samples->is_object() && samples->contains(to_name(kind));
}

std::int64_t Plan::power_of_two_for_all(const BenchOptions& options) const
{
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (const IntegratorKind kind : options.integrators) {
        least = std::min(least, number(samples_member, std::string(to_name(kind))));
    }
    std::int64_t power = 1;
    while (2 * power <= least) {
        power *= 2;
    }
    return power;
}

std::int64_t Plan::number(const std::string& member, const std::string& name) const
{
    const ordered_json& object = member.empty() ? json_ : json_.at(member);
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number_integer() || *found < 1 ||
        *found > max_samples) {
        throw Error(ErrorCode::invalid_input, file_.string() + ": " + name +
                                                  " is not a number of samples; delete the folder "
                                                  "to start again");
    }
    return found->get<std::int64_t>();
}

}  // namespace bdpt::eval
