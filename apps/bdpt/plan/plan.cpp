#include "plan/plan.h"

#include <bdpt/error.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <fstream>
#include <iterator>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "options/values/file_pattern.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr int format = 2;

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

SampleRange read_range(const ordered_json& json, const char* what)
{
    const auto set = SampleSet::parse(json.get<std::string>());
    if (!set || set->ranges().size() != 1) {
        throw std::runtime_error(fmt::format("the {} of a task are no range", what));
    }
    return set->ranges().front();
}

PlanTask read_task(const ordered_json& json, std::size_t images)
{
    const SampleRange range = read_range(json.at("images"), "images");
    const auto first = static_cast<std::size_t>(range.begin);
    const auto end = static_cast<std::size_t>(range.end);
    if (end > images) {
        throw std::runtime_error(
            fmt::format("a task has the images {}:{}, but there are {}", first, end, images));
    }
    return {.first_image = first,
            .images = end - first,
            .samples = read_range(json.at("samples"), "samples"),
            .part = json.at("part").get<std::string>()};
}

PlanImage read_image(const ordered_json& json)
{
    PlanImage image;
    if (json.contains("frame")) {
        image.frame = json["frame"].get<int>();
    }
    if (json.contains("camera")) {
        image.camera = json["camera"].get<std::string>();
    }
    if (json.contains("seed")) {
        image.seed = json["seed"].get<std::uint64_t>();
    }
    return image;
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

Identity read_identity(const ordered_json& json)
{
    Identity identity;
    for (const auto& [name, value] : json.items()) {
        identity.components.push_back({.name = name, .value = value.get<std::string>()});
    }
    return identity;
}

ordered_json to_json(const Identity& identity)
{
    ordered_json json = ordered_json::object();
    for (const auto& [name, value] : identity.components) {
        json[name] = value;
    }
    return json;
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
    if (json.contains("rates")) {
        plan.rates = json.at("rates").get<std::string>();
    }
    plan.render_options = json.at("render").get<std::vector<std::string>>();
    plan.merge_options = json.at("merge").get<std::vector<std::string>>();
    plan.outputs = read_paths(json.at("outputs"));
    if (!json.at("strategies").is_null()) {
        plan.strategies = json.at("strategies").get<std::string>();
    }
    plan.engine_files = read_paths(json.at("engine_files"));
    plan.images.clear();
    for (const ordered_json& image : json.at("images")) {
        plan.images.push_back(read_image(image));
    }
    for (const ordered_json& task : json.at("tasks")) {
        plan.tasks.push_back(read_task(task, plan.images.size()));
    }
    if (plan.tasks.empty()) {
        throw std::runtime_error("no tasks");
    }
    plan.identity = read_identity(json.at("identity"));
    plan.files = read_identity(json.at("files"));
    return plan;
}

/// Numbers that follow each other.
struct Run {
    std::size_t first = 0;
    std::size_t last = 0;
};

std::vector<Run> runs_of(const std::vector<std::size_t>& numbers)
{
    std::vector<Run> runs;
    for (const std::size_t number : numbers) {
        if (!runs.empty() && runs.back().last + 1 == number) {
            runs.back().last = number;
        } else {
            runs.push_back({.first = number, .last = number});
        }
    }
    return runs;
}

/// "frame 3", "camera left", "frame 3 of camera left"
std::string image_text(const PlanImage& image)
{
    const std::string camera = image.camera ? "camera " + one_line(*image.camera) : "";
    if (!image.frame) {
        return camera;
    }
    return fmt::format("frame {}{}{}", *image.frame, camera.empty() ? "" : " of ", camera);
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

bool is_sequence(const Plan& plan)
{
    return plan.images.front().seed.has_value();
}

std::vector<std::string> cameras_of(const Plan& plan)
{
    std::vector<std::string> cameras;
    for (const PlanImage& image : plan.images) {
        if (image.camera && image.frame == plan.images.front().frame) {
            cameras.push_back(*image.camera);
        }
    }
    return cameras;
}

fs::path file_of(const fs::path& pattern, const PlanImage& image)
{
    const fs::path file = image.frame ? with_number(pattern, *image.frame) : pattern;
    return image.camera ? with_camera(file, *image.camera) : file;
}

std::vector<fs::path> parts_of(const Plan& plan, std::size_t image)
{
    std::vector<fs::path> parts;
    for (const PlanTask& task : plan.tasks) {
        if (renders(task, image, SampleSet(task.samples))) {
            parts.push_back(file_of(task.part, plan.images[image]));
        }
    }
    return parts;
}

std::vector<fs::path> parts_of(const Plan& plan)
{
    std::vector<fs::path> parts;
    for (const PlanTask& task : plan.tasks) {
        for (std::size_t i = 0; i < task.images; ++i) {
            parts.push_back(file_of(task.part, plan.images[task.first_image + i]));
        }
    }
    return parts;
}

bool renders(const PlanTask& task, std::size_t image, const SampleSet& samples)
{
    return image >= task.first_image && image - task.first_image < task.images &&
           !samples.overlap(SampleSet(task.samples)).empty();
}

ImageLabel label_of(const Plan& plan, std::size_t image)
{
    return {.frame = plan.images[image].frame,
            .camera = plan.images[image].camera,
            .index = image,
            .count = plan.images.size()};
}

std::string images_text(const Plan& plan, const std::vector<std::size_t>& images)
{
    constexpr std::size_t most_runs = 8;
    const std::vector<Run> runs = runs_of(images);
    std::string text;
    for (std::size_t i = 0; i < std::min(runs.size(), most_runs); ++i) {
        text += (text.empty() ? "" : ", ") + image_text(plan.images[runs[i].first]);
        if (runs[i].first != runs[i].last) {
            text += " to " + image_text(plan.images[runs[i].last]);
        }
    }
    return runs.size() > most_runs ? text + ", ..." : text;
}

std::string numbers_text(const std::vector<std::size_t>& numbers)
{
    std::string result;
    for (const Run& run : runs_of(numbers)) {
        result += result.empty() ? "" : ",";
        result += run.first == run.last ? fmt::format("{}", run.first)
                                        : fmt::format("{}-{}", run.first, run.last);
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
                      {"strategies", ordered_json()},
                      {"engine_files", texts_of(plan.engine_files)},
                      {"images", ordered_json::array()},
                      {"tasks", ordered_json::array()},
                      {"files", to_json(plan.files)},
                      {"identity", to_json(plan.identity)}};
    if (plan.environment) {
        json["environment"] = plan.environment->string();
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
    for (const PlanTask& task : plan.tasks) {
        json["tasks"].push_back(to_json(task));
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
