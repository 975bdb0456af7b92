#include <bdpt/error.h>
#include <bdpt/io/json_value.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "plan/plan_file.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::vector<std::string> to_texts(const std::vector<fs::path>& paths)
{
    std::vector<std::string> result;
    for (const fs::path& path : paths) {
        result.push_back(path.string());
    }
    return result;
}

ordered_json to_json(const PlanImage& image)
{
    ordered_json json = ordered_json::object();
    if (image.frame) {
        json["frame"] = *image.frame;
    }
    if (image.camera) {
        json["camera"] = *image.camera;
    }
    if (image.seed) {
        json["seed"] = *image.seed;
    }
    return json;
}

ordered_json to_json(const PlanTask& task)
{
    const SampleRange images{.begin = static_cast<std::int64_t>(task.first_image),
                             .end = static_cast<std::int64_t>(task.first_image + task.images)};
    return {{"images", SampleSet(images).text()},
            {"samples", SampleSet(task.samples).text()},
            {"part", task.part.string()}};
}

ordered_json to_json(const Identity& identity)
{
    // Names are unique; a search for each would take quadratic time.
    ordered_json::object_t members;
    for (const auto& [name, value] : identity.components) {
        members.emplace_back(name, value);
    }
    return members;
}

}  // namespace

std::string to_text(const Plan& plan)
{
    ordered_json json{{"format", plan_format},
                      {"version", BDPT_VERSION},
                      {"scene", plan.scene.string()},
                      {"environment", ordered_json()},
                      {"render", plan.render_options},
                      {"merge", plan.merge_options},
                      {"outputs", to_texts(plan.outputs)},
                      {"strategies", ordered_json()},
                      {"engine_files", to_texts(plan.engine_files)},
                      {"images", ordered_json::array()},
                      {"tasks", ordered_json::array()},
                      {"files", to_json(plan.files)},
                      {"identity", to_json(plan.identity)}};
    if (plan.environment) {
        json["environment"] = plan.environment->string();
    }
    if (plan.volume) {
        json["volume"] = plan.volume->string();
    }
    if (plan.strategies) {
        json["strategies"] = plan.strategies->string();
    }
    if (plan.rates) {
        json["rates"] = plan.rates->string();
    }
    for (const PlanImage& image : plan.images) {
        json["images"].push_back(to_json(image));
    }
    std::size_t parts = 0;
    for (const PlanTask& task : plan.tasks) {
        json["tasks"].push_back(to_json(task));
        parts += task.images;
    }
    try {
        std::string text = json.dump(2) + "\n";
        if (parts > max_planned_parts || text.size() > io::JsonValue::max_bytes) {
            throw Error(ErrorCode::usage,
                        fmt::format("a plan of {} parts is too large: the limits are {} parts and "
                                    "{} bytes of text",
                                    parts, max_planned_parts, io::JsonValue::max_bytes));
        }
        return text;
    } catch (const ordered_json::type_error&) {
        throw Error(ErrorCode::usage,
                    "a plan must be UTF-8: the name of a file or a value of an option is not");
    }
}

}  // namespace bdpt::app
