#include <bdpt/error.h>
#include <bdpt/io/json_value.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "options/plan_arguments.h"
#include "plan/plan_file.h"
#include "plan/planned_files.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using io::JsonValue;

std::vector<fs::path> read_paths(const JsonValue& json)
{
    const std::vector<std::string> texts = json.texts();
    return {texts.begin(), texts.end()};
}

std::optional<fs::path> read_optional_path(const JsonValue& json, const char* key)
{
    if (!json.has(key) || json.at(key).is_null()) {
        return std::nullopt;
    }
    return json.at(key).text();
}

/// Reads words of a command, which may come from anybody: only `allowed` options are accepted.
std::vector<std::string> read_words(const JsonValue& json, const std::vector<std::string>& allowed)
{
    std::vector<std::string> words;
    for (const JsonValue& element : json.elements()) {
        words.push_back(element.text());
        const std::string& word = words.back();
        const std::string name = word.substr(0, word.find('='));
        const bool is_allowed = std::find(allowed.begin(), allowed.end(), name) != allowed.end();
        const bool names_file = name == "--env" && word != "--env=none" && word != "--env=default";
        if (!is_allowed || names_file) {
            element.fail_expecting("an option that a plan may have");
        }
    }
    return words;
}

SampleRange read_range(const JsonValue& json)
{
    const auto set = SampleSet::parse(json.text());
    if (!set || set->ranges().size() != 1) {
        json.fail_expecting("a range, like 0:64");
    }
    return set->ranges().front();
}

PlanTask read_task(const JsonValue& json, std::size_t images)
{
    const SampleRange range = read_range(json.at("images"));
    const auto first = static_cast<std::size_t>(range.begin);
    const auto end = static_cast<std::size_t>(range.end);
    if (end > images) {
        json.at("images").fail_expecting(fmt::format("a range of the {} images", images));
    }
    PlanTask task{.first_image = first,
                  .images = end - first,
                  .samples = read_range(json.at("samples")),
                  .part = json.at("part").text()};
    if (!is_part_of_task(task.part.string())) {
        json.at("part").fail_expecting("a name like task-0.part.exr");
    }
    return task;
}

PlanImage read_image(const JsonValue& json)
{
    PlanImage image;
    if (json.has("frame")) {
        image.frame = json.at("frame").number<int>();
    }
    if (json.has("camera")) {
        image.camera = json.at("camera").text();
    }
    if (json.has("seed")) {
        image.seed = json.at("seed").number<std::uint64_t>();
    }
    return image;
}

Identity read_identity(const JsonValue& json)
{
    Identity identity;
    for (const auto& [name, value] : json.members()) {
        identity.components.push_back({.name = name, .value = value.text()});
    }
    return identity;
}

void read_images_and_tasks(const JsonValue& json, Plan& plan)
{
    plan.images.clear();
    for (const JsonValue& image : json.at("images").elements()) {
        plan.images.push_back(read_image(image));
    }
    std::size_t parts = 0;
    for (const JsonValue& task : json.at("tasks").elements()) {
        plan.tasks.push_back(read_task(task, plan.images.size()));
        parts += plan.tasks.back().images;
        if (parts > max_planned_parts) {
            task.fail(fmt::format("has more than {} parts, the maximum", max_planned_parts));
        }
    }
    if (plan.tasks.empty()) {  // each task names existing images
        json.at("tasks").fail_expecting("an array of one value or more");
    }
}

Plan read(const JsonValue& json)
{
    if (!json.is_object() || !json.has("format") || !json.has("tasks")) {
        json.fail("is not a plan of bdpt plan");
    }
    if (const std::string format = json.at("format").scalar_text();
        format != std::to_string(plan_format)) {
        json.fail(fmt::format("is not a plan of bdpt plan: format {}, but this program reads {}",
                              format, plan_format));
    }
    const PlannableOptions allowed = plannable_options();
    Plan plan{.scene = json.at("scene").text(),
              .environment = read_optional_path(json, "environment"),
              .volume = read_optional_path(json, "volume"),
              .rates = read_optional_path(json, "rates"),
              .render_options = read_words(json.at("render"), allowed.render),
              .merge_options = read_words(json.at("merge"), allowed.merge),
              .outputs = read_paths(json.at("outputs")),
              .strategies = read_optional_path(json, "strategies"),
              .engine_files = read_paths(json.at("engine_files"))};
    if (plan.rates && *plan.rates != rates_name) {
        json.at("rates").fail_expecting(rates_name);
    }
    for (const JsonValue& name : json.at("engine_files").elements()) {
        if (!is_engine_file(name.text())) {
            name.fail_expecting("the name of a file of an engine");
        }
    }
    read_images_and_tasks(json, plan);
    plan.identity = read_identity(json.at("identity"));
    plan.files = read_identity(json.at("files"));
    return plan;
}

}  // namespace

Plan read_plan(const fs::path& file)
{
    return read(JsonValue::read(file));
}

fs::path resolved(const fs::path& path, const fs::path& plan_file)
{
    // "job/.." is resolved by the system, even if job is a symbolic link.
    std::error_code ignored;
    const fs::path folder = fs::absolute(plan_file, ignored).parent_path();
    const fs::path result = fs::weakly_canonical(path == "." ? folder : folder / path, ignored);
    return result.empty() ? folder / path : result;
}

}  // namespace bdpt::app
