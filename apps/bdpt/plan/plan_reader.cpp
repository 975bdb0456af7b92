#include <bdpt/error.h>
#include <fmt/core.h>

#include <cstdint>
#include <exception>
#include <fstream>
#include <iterator>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>

#include "plan/plan_file.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

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

Identity read_identity(const ordered_json& json)
{
    Identity identity;
    for (const auto& [name, value] : json.items()) {
        identity.components.push_back({.name = name, .value = value.get<std::string>()});
    }
    return identity;
}

Plan read(const ordered_json& json)
{
    if (json.at("format").get<int>() != plan_format) {
        throw std::runtime_error(fmt::format("format {}, where this program knows {}",
                                             json.at("format").dump(), plan_format));
    }
    Plan plan{.scene = json.at("scene").get<std::string>()};
    if (!json.at("environment").is_null()) {
        plan.environment = json.at("environment").get<std::string>();
    }
    if (json.contains("volume")) {
        plan.volume = json.at("volume").get<std::string>();
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
    if (plan.tasks.empty()) {  // each names images that there are
        throw std::runtime_error("no tasks");
    }
    plan.identity = read_identity(json.at("identity"));
    plan.files = read_identity(json.at("files"));
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
