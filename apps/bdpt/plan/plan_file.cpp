#include "plan/plan_file.h"

#include <bdpt/error.h>
#include <bdpt/io/json_value.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "options/plan_arguments.h"

namespace bdpt::app {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> engine_file_names{
    "submit.sh", "tasks.sbatch", "merge.sbatch", "kubernetes.yaml", "Makefile"};

constexpr std::string_view part_start = "task-";
constexpr std::string_view frame_place = ".####";
constexpr std::string_view camera_suffix = ".{camera}";
constexpr std::string_view part_end = ".part.exr";

/// Removes `start` from the front of `text`; returns false if it is not there.
bool take(std::string_view& text, std::string_view start)
{
    const bool is_there = text.starts_with(start);
    text.remove_prefix(is_there ? start.size() : 0);
    return is_there;
}

}  // namespace

std::string part_name(const PlanImage& image, std::size_t task, std::size_t count)
{
    const std::size_t digits = std::to_string(count - 1).size();
    return fmt::format("{}{:0{}}{}{}{}", part_start, task, digits, image.frame ? frame_place : "",
                       image.camera ? camera_suffix : "", part_end);
}

bool is_part_of_task(std::string_view name)
{
    if (!take(name, part_start)) {
        return false;
    }
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    name.remove_prefix(digits);
    take(name, frame_place);
    take(name, camera_suffix);
    return digits > 0 && name == part_end;
}

bool is_engine_file(std::string_view name)
{
    return std::find(engine_file_names.begin(), engine_file_names.end(), name) !=
           engine_file_names.end();
}

fs::path file_of_plan(const fs::path& name, const fs::path& folder)
{
    const fs::path file = folder / name;
    std::error_code ignored;
    if (fs::is_symlink(file, ignored)) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}: is a symbolic link; the files of a plan must be in its folder",
                                file.string()));
    }
    return file;
}

namespace {

using nlohmann::ordered_json;

std::vector<std::string> to_texts(const std::vector<fs::path>& paths)
{
    std::vector<std::string> result;
    for (const fs::path& path : paths) {
        result.push_back(path.string());
    }
    return result;
}

ordered_json path_or_null(const std::optional<fs::path>& path)
{
    return path ? ordered_json(path->string()) : ordered_json();
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
                      {"environment", path_or_null(plan.environment)},
                      {"render", plan.render_options},
                      {"merge", plan.merge_options},
                      {"outputs", to_texts(plan.outputs)},
                      {"strategies", path_or_null(plan.strategies)},
                      {"engine_files", to_texts(plan.engine_files)},
                      {"images", ordered_json::array()},
                      {"tasks", ordered_json::array()},
                      {"files", to_json(plan.files)},
                      {"identity", to_json(plan.identity)}};
    if (plan.volume) {
        json["volume"] = plan.volume->string();
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

namespace {

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
