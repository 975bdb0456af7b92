#include "plan/plan.h"

#include <bdpt/error.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <iterator>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr int format = 1;

std::vector<std::string> texts_of(const std::vector<fs::path>& paths)
{
    std::vector<std::string> result;
    for (const fs::path& path : paths) {
        result.push_back(path.string());
    }
    return result;
}

std::vector<fs::path> read_paths(const ordered_json& json)
{
    const auto texts = json.get<std::vector<std::string>>();
    return {texts.begin(), texts.end()};
}

PlanTask read_task(const ordered_json& json)
{
    const auto samples = SampleSet::parse(json.at("samples").get<std::string>());
    if (!samples || samples->ranges().size() != 1) {
        throw std::runtime_error("the samples of a task are no range");
    }
    return {.samples = samples->ranges().front(), .part = json.at("part").get<std::string>()};
}

Plan read(const ordered_json& json)
{
    if (json.at("format").get<int>() != format) {
        throw std::runtime_error(fmt::format("format {}, where this program knows {}",
                                             json.at("format").dump(), format));
    }
    Plan plan{.scene = json.at("scene").get<std::string>()};
    if (!json.at("environment").is_null()) {
        plan.environment = json.at("environment").get<std::string>();
    }
    plan.render_options = json.at("render").get<std::vector<std::string>>();
    plan.merge_options = json.at("merge").get<std::vector<std::string>>();
    plan.outputs = read_paths(json.at("outputs"));
    plan.engine_files = read_paths(json.at("engine_files"));
    for (const ordered_json& task : json.at("tasks")) {
        plan.tasks.push_back(read_task(task));
    }
    if (plan.tasks.empty()) {
        throw std::runtime_error("no tasks");
    }
    for (const auto& [name, value] : json.at("identity").items()) {
        plan.identity.components.push_back({.name = name, .value = value.get<std::string>()});
    }
    return plan;
}

std::string text_of(const fs::path& file)
{
    std::error_code ignored;
    std::ifstream stream(file, std::ios::binary);
    if (!stream || fs::is_directory(file, ignored)) {
        throw Error(ErrorCode::not_found,
                    fmt::format("{}: {}", file.string(),
                                fs::exists(file, ignored) ? "cannot be read" : "no such file"));
    }
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

SampleSet samples_of(const Plan& plan)
{
    SampleSet result;
    for (const PlanTask& task : plan.tasks) {
        result.add(task.samples);
    }
    return result;
}

std::string tasks_text(const Plan& plan, const SampleSet& samples)
{
    std::string result;
    const auto wanted = [&](std::size_t task) {
        return task < plan.tasks.size() &&
               !samples.overlap(SampleSet(plan.tasks[task].samples)).empty();
    };
    for (std::size_t first = 0; first < plan.tasks.size(); ++first) {
        if (!wanted(first)) {
            continue;
        }
        std::size_t last = first;
        while (wanted(last + 1)) {
            ++last;
        }
        result += result.empty() ? "" : ",";
        result += first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last);
        first = last;
    }
    return result;
}

std::string to_text(const Plan& plan)
{
    ordered_json json{{"format", format},
                      {"version", BDPT_VERSION},
                      {"scene", plan.scene.string()},
                      {"environment", ordered_json()},
                      {"render", plan.render_options},
                      {"merge", plan.merge_options},
                      {"outputs", texts_of(plan.outputs)},
                      {"engine_files", texts_of(plan.engine_files)},
                      {"tasks", ordered_json::array()},
                      {"identity", ordered_json::object()}};
    if (plan.environment) {
        json["environment"] = plan.environment->string();
    }
    for (const PlanTask& task : plan.tasks) {
        json["tasks"].push_back(
            {{"samples", SampleSet(task.samples).text()}, {"part", task.part.string()}});
    }
    for (const auto& [name, value] : plan.identity.components) {
        json["identity"][name] = value;
    }
    try {
        return json.dump(2) + "\n";
    } catch (const ordered_json::type_error&) {
        throw Error(ErrorCode::usage,
                    "a plan holds UTF-8 only: the name of a file or a value of an option is not");
    }
}

Plan read_plan(const fs::path& file)
{
    const std::string text = text_of(file);
    try {
        return read(ordered_json::parse(text));
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}: is no plan of bdpt plan: {}", file.string(), error.what()));
    }
}

fs::path resolved(const fs::path& path, const fs::path& plan_file)
{
    // "job/.." is what the system takes it for, even where job is a symbolic link.
    std::error_code ignored;
    const fs::path folder = fs::absolute(plan_file, ignored).parent_path();
    const fs::path result = fs::weakly_canonical(folder / path, ignored);
    return result.empty() ? folder / path : result;
}

}  // namespace bdpt::app
