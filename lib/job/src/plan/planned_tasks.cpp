#include "plan/plan.h"

#include <bdpt/io/gltf.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <string_view>

#include "options/option_list.h"
#include "options/value_types.h"

namespace bdpt::job {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr std::array<std::string_view, 7> of_a_process{
    "--plan", "--task", "--threads", "--max-memory", "--stats", "--ktx-library", "--allow-folder"};
constexpr std::array<std::string_view, 6> flags_of_a_process{"--restart", "-q",        "--quiet",
                                                             "-v",        "--verbose", "--json"};

std::string parse_name(const std::string& word)
{
    return word.substr(0, word.find('='));
}

/// Returns the last value of the option `name`.
std::optional<std::string> find_value(const Words& words, std::string_view name)
{
    std::optional<std::string> result;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (parse_name(words[i]) != name) {
            continue;
        }
        if (words[i].size() > name.size()) {
            result = words[i].substr(name.size() + 1);
        } else if (i + 1 < words.size()) {
            result = words[i + 1];
        }
    }
    return result;
}

/// Throws for words that the plan already defines.
void check_render_words(const Words& words)
{
    for (std::size_t i = 2; i < words.size(); ++i) {
        if (is_among(of_a_process, words[i])) {
            ++i;  // its value
        } else if (!is_among(of_a_process, parse_name(words[i])) &&
                   !is_among(flags_of_a_process, words[i])) {
            throw OptionError(
                fmt::format("--plan cannot be combined with {}, only with --task, --threads, "
                            "--max-memory, --stats, --ktx-library, --allow-folder, --restart, "
                            "--quiet, --verbose and --json",
                            words[i]));
        }
    }
}

bool names_output(const std::string& word)
{
    const bool short_options = word.size() > 1 && word[0] == '-' && word[1] != '-';
    return parse_name(word) == "--output" || (short_options && word.find('o') != std::string::npos);
}

void append(Words& words, Words more)
{
    words.insert(words.end(), std::make_move_iterator(more.begin()),
                 std::make_move_iterator(more.end()));
}

Words render_words(const Words& words, const Plan& plan, const fs::path& file)
{
    check_render_words(words);
    const std::optional<std::string> number = find_value(words, "--task");
    if (!number) {
        throw OptionError("--plan needs --task N");
    }
    const PlanTask& task = find_task(plan, file, *number);
    Words result(words.begin(), words.begin() + 2);
    append(result, shared_words(plan, file));
    result.push_back("--samples=" + SampleSet(task.samples).text());
    result.push_back("--part=" + file_of_plan(task.part, resolved(".", file)).string());
    append(result, {words.begin() + 2, words.end()});
    return result;
}

Words merge_words(const Words& words, const Plan& plan, const fs::path& file)
{
    Words result(words.begin(), words.begin() + 2);
    append(result, plan.merge_options);
    if (std::none_of(words.begin() + 2, words.end(), names_output)) {
        for (const fs::path& output : plan.outputs) {
            result.push_back("--output=" + resolved(output, file).string());
        }
        if (plan.strategies) {
            result.push_back("--strategies=" + resolved(*plan.strategies, file).string());
        }
    }
    append(result, {words.begin() + 2, words.end()});
    return result;
}

}  // namespace

std::vector<std::string> with_planned_words(std::vector<std::string> words)
{
    const bool render = words.size() > 1 && words[1] == "render";
    const bool merge = words.size() > 1 && words[1] == "merge";
    const std::optional<std::string> file = find_value(words, "--plan");
    if (!(render || merge) || !file || is_among(words, "--help") || is_among(words, "-h")) {
        return words;
    }
    const Plan plan = read_plan(*file);
    return render ? render_words(words, plan, *file) : merge_words(words, plan, *file);
}

const PlanTask& find_task(const Plan& plan, const fs::path& file, const std::string& asked)
{
    std::string number = asked;
    constexpr std::string_view variable = "env:";
    if (number.starts_with(variable)) {
        const char* value = std::getenv(number.c_str() + variable.size());
        if (value == nullptr) {
            reject("--task", number, "an environment variable that is set");
        }
        number = value;
    }
    const std::optional<std::size_t> index = parse_index(number);
    if (!index || *index >= plan.tasks.size()) {
        reject("--task", number,
               fmt::format("a task of {}, 0 to {}", file.string(), plan.tasks.size() - 1));
    }
    return plan.tasks[*index];
}

std::vector<std::string> shared_words(const Plan& plan, const fs::path& file)
{
    Words result{resolved(plan.scene, file).string()};
    append(result, plan.render_options);
    if (plan.environment) {
        result.push_back("--env=" + resolved(*plan.environment, file).string());
    }
    if (plan.volume) {
        result.push_back("--volume=" + resolved(*plan.volume, file).string());
    }
    if (plan.rates) {
        result.push_back("--rates=" + file_of_plan(*plan.rates, resolved(".", file)).string());
    }
    return result;
}

namespace {

constexpr const char* seed_name = "option: seed";

/// Returns the options that may differ between images of the sequence.
std::vector<std::string_view> own_options(const RenderArguments& asked)
{
    std::vector<std::string_view> names{seed_name};
    if (asked.options.integrator == IntegratorKind::automatic) {
        names.insert(names.end(),
                     {"option: integrator", "option: light_paths", "option: connections",
                      "option: connection_rays", "option: disable", "option: rates"});
    }
    if (asked.sequence->cameras == SequenceCameras::all && !asked.size) {
        names.insert(names.end(), {"option: width", "option: height"});
    }
    return names;
}

IdentityComponent file_component(const std::string& name, const std::optional<ContentHash>& hash)
{
    return {.name = "file: " + name, .value = hash ? "#" + to_string(*hash) : "none"};
}

}  // namespace

PlannedIdentity planned_identity(const Plan& plan, std::size_t image)
{
    PlannedIdentity result{.identity = plan.identity, .whole = !is_sequence(plan)};
    if (const std::optional<std::uint64_t> seed = plan.images.at(image).seed) {
        result.identity.components.push_back({.name = seed_name, .value = std::to_string(*seed)});
    }
    return result;
}

std::optional<std::string> difference(const Identity& found, const PlannedIdentity& planned)
{
    if (planned.whole) {
        return difference(found, planned.identity);
    }
    std::map<std::string_view, const IdentityComponent*> by_name;
    for (const IdentityComponent& component : found.components) {
        by_name.emplace(component.name, &component);
    }
    Identity known;
    for (const IdentityComponent& component : planned.identity.components) {
        const auto its = by_name.find(component.name);
        if (its != by_name.end()) {
            known.components.push_back(*its->second);
        }
    }
    return difference(known, planned.identity);
}

Identity common_identity(const Identity& of_one, const RenderArguments& asked)
{
    const std::vector<std::string_view> own = own_options(asked);
    Identity result;
    for (const IdentityComponent& component : of_one.components) {
        const bool is_option = component.name.starts_with("option: ");
        const bool is_own = is_among(own, component.name);
        if (component.name.starts_with("build: ") || (is_option && !is_own)) {
            result.components.push_back(component);
        }
    }
    return result;
}

Identity identity_of_files(const RenderArguments& asked)
{
    Identity result;
    for (const io::FileContent& file :
         io::gltf_file_contents(asked.file, {}, asked.scene.allowed_folders)) {
        result.components.push_back(file_component(file.name, file.hash));
    }
    const std::string environment = asked.environment.value_or("none");
    if (is_file_of_environment(environment)) {
        const std::filesystem::path file = environment;
        result.components.push_back(
            file_component("--env " + file.filename().string(), io::hash_of_file(file)));
    }
    if (asked.volume) {
        const std::filesystem::path& file = asked.volume->file;
        result.components.push_back(
            file_component("--volume " + file.filename().string(), io::hash_of_file(file)));
    }
    return result;
}

}  // namespace bdpt::job
