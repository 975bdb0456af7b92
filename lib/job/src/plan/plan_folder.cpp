#include "options/output_files.h"
#include "options/value_types.h"
#include "plan/plan.h"

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "messages/text.h"

namespace bdpt::job {

namespace {

namespace fs = std::filesystem;

/// Replaces @NAME@ in `text` by its value.
std::string filled(std::string_view text,
                   const std::vector<std::pair<std::string, std::string>>& values)
{
    std::string result;
    std::size_t position = 0;
    while (position < text.size()) {
        const auto here = std::find_if(values.begin(), values.end(), [&](const auto& value) {
            const std::string mark = "@" + value.first + "@";
            return text.compare(position, mark.size(), mark) == 0;
        });
        if (here == values.end()) {
            result += text[position++];
        } else {
            result += here->second;
            position += here->first.size() + 2;
        }
    }
    return result;
}

/// Paths of a plan in a container that has the planned files in /data.
struct ContainerPlace {
    fs::path shared;   ///< host folder mounted at /data
    fs::path working;  ///< container folder with plan.json
};

fs::path common_folder(const fs::path& a, const fs::path& b)
{
    fs::path result;
    const auto [end, ignored] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    for (auto name = a.begin(); name != end; ++name) {
        result /= *name;
    }
    return result;
}

/// Returns the smallest folder that contains the plan's folder and all its files named by relative
/// paths. `folder` is that of the plan, absolute.
ContainerPlace container_place(const Plan& plan, const fs::path& folder)
{
    fs::path shared = folder;
    const auto include = [&](const fs::path& file) {
        if (file.is_relative()) {
            shared = common_folder(shared, (folder / file).lexically_normal().parent_path());
        }
    };
    include(plan.scene);
    if (plan.environment) {
        include(*plan.environment);
    }
    if (plan.volume) {
        include(*plan.volume);
    }
    for (const fs::path& output : plan.outputs) {
        include(output);
    }
    return {.shared = shared,
            .working = (fs::path("/data") / folder.lexically_relative(shared)).lexically_normal()};
}

/// Returns a job name that Kubernetes accepts: "bdpt-" and the small letters and digits of the
/// folder's name.
std::string job_name(const fs::path& folder)
{
    constexpr std::size_t longest = 40;
    std::string result = "bdpt-";
    for (const char c : folder.filename().string()) {
        const auto letter = static_cast<unsigned char>(c);
        const bool plain = letter < 0x80 && std::isalnum(letter) != 0;
        if (plain) {
            result += static_cast<char>(std::tolower(letter));
        } else if (result.back() != '-') {
            result += '-';
        }
    }
    result.resize(std::min(result.size(), longest));
    while (result.back() == '-') {
        result.pop_back();
    }
    return result;
}

/// Returns the path of this program, quoted for a shell in a makefile. make runs on this machine,
/// where `bdpt` may be another program, or none.
std::string this_program()
{
    std::error_code unknown;
    const fs::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
    std::string text;
    for (const char c : shell_word(unknown ? "bdpt" : program.string())) {
        text += c == '$' ? "$$" : c == '#' ? "\\#" : std::string(1, c);
    }
    return text;
}

/// A file of an engine. Tasks of the makefile are phony: bdpt decides by the samples in a part
/// whether its task is done. By time stamps the checkpoint of a killed task would count as
/// complete. Of the exit codes in the policy of Kubernetes, 143 means that the pod was evicted, and
/// has written its part; after 2 to 5, retrying in another pod would not help.
struct EngineTemplate {
    Engine engine;
    std::string_view name;
    std::string_view (*text)();
};

constexpr std::array<EngineTemplate, 5> engine_template_list{{
    {Engine::slurm, "submit.sh", engine_texts::submit_sh},
    {Engine::slurm, "tasks.sbatch", engine_texts::tasks_sbatch},
    {Engine::slurm, "merge.sbatch", engine_texts::merge_sbatch},
    {Engine::kubernetes, "kubernetes.yaml", engine_texts::kubernetes},
    {Engine::make, "Makefile", engine_texts::makefile},
}};

std::string read_template(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream || text.empty()) {
        throw Error(ErrorCode::not_found, fmt::format("{}: cannot read this file", file.string()));
    }
    return text;
}

}  // namespace

bool is_engine_file(std::string_view name)
{
    return std::any_of(engine_template_list.begin(), engine_template_list.end(),
                       [name](const EngineTemplate& known) { return known.name == name; });
}

std::vector<EngineFile> engine_templates(Engine engine, const std::vector<fs::path>& changed)
{
    std::vector<EngineFile> files;
    std::vector<std::string> names;
    for (const EngineTemplate& known : engine_template_list) {
        if (known.engine == engine) {
            files.push_back({.name = std::string(known.name), .text = std::string(known.text())});
            names.emplace_back(known.name);
        }
    }
    for (const fs::path& file : changed) {
        const auto found = std::find(names.begin(), names.end(), file.filename());
        if (found == names.end()) {
            reject("--template", file.string(),
                   fmt::format("a file with the name {}", words_text(names)));
        }
        files[static_cast<std::size_t>(found - names.begin())].text = read_template(file);
    }
    return files;
}

std::vector<EngineFile> engine_files(std::vector<EngineFile> templates, const Plan& plan,
                                     const fs::path& folder)
{
    const ContainerPlace place = container_place(plan, folder);
    std::string tasks;
    for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
        tasks += fmt::format(" task-{}", i);
    }
    const std::vector<std::pair<std::string, std::string>> values{
        {"COUNT", fmt::format("{}", plan.tasks.size())},
        {"LAST", fmt::format("{}", plan.tasks.size() - 1)},
        {"TASKS", tasks},
        {"PROGRAM", this_program()},
        {"NAME", job_name(folder)},
        {"VERSION", BDPT_VERSION},
        {"SHARED", one_line(place.shared.string())},
        {"WORKING", nlohmann::json(place.working.string()).dump()}};
    for (EngineFile& file : templates) {
        file.text = filled(file.text, values);
    }
    return templates;
}

std::string start_command(Engine engine, const fs::path& folder)
{
    switch (engine) {
        case Engine::slurm:
            return shell_word((folder / "submit.sh").string());
        case Engine::kubernetes:
            return fmt::format("kubectl apply -f {}",
                               shell_word((folder / "kubernetes.yaml").string()));
        case Engine::make:
            break;
    }
    return fmt::format("make -C {} -j4 -k", shell_word(folder.string()));
}

namespace {

void write_file(const fs::path& file, const std::string& text)
{
    write_text(file, text);
    if (file.extension() == ".sh") {
        std::error_code failure;  // if it fails, the user can run "bash submit.sh"
        fs::permissions(file,
                        fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                        fs::perm_options::add, failure);
    }
}

/// Reads an existing plan, if that is possible.
std::optional<Plan> old_plan(const fs::path& file)
{
    try {
        return read_plan(file);
    } catch (const Error&) {
        return std::nullopt;
    }
}

/// Removes an old plan: its parts are useless for the new one, and its tasks would be refused. Only
/// files in its folder that bdpt has created are removed: `read_plan` accepts no others.
void remove_plan(const fs::path& file)
{
    const std::optional<Plan> plan = old_plan(file);
    const auto remove = [folder = file.parent_path()](const fs::path& name) {
        std::error_code nothing_there;
        fs::remove(folder / name.filename(), nothing_there);  // removes a link, not its target
    };
    std::error_code ignored;
    if (fs::is_regular_file(fs::symlink_status(file, ignored))) {
        remove(plan_name);  // a link or a device is kept, and written into
    }
    if (!plan) {
        return;
    }
    for (const std::vector<fs::path>& parts : parts_by_image(*plan)) {
        std::for_each(parts.begin(), parts.end(), remove);
    }
    if (plan->rates) {
        remove(*plan->rates);
    }
    std::for_each(plan->engine_files.begin(), plan->engine_files.end(), remove);
}

}  // namespace

void check_plan_folder(const fs::path& folder)
{
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored)) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot write: this is not a folder", folder.string()));
    }
    // A missing folder is created beside existing ones.
    io::check_writable(fs::exists(folder, ignored)
                           ? folder / plan_name
                           : fs::path((folder / ".").lexically_normal().parent_path()) += ".new");
}

void write_plan(const fs::path& folder, const Plan& plan, const std::vector<EngineFile>& files,
                const std::function<void(const fs::path&)>& write_rates, ExistingPlan existing)
{
    const fs::path file = folder / plan_name;
    const std::string text = to_text(plan);
    std::error_code failure;
    if (fs::exists(file, failure)) {
        if (existing == ExistingPlan::replace) {
            remove_plan(file);
        } else if (old_plan(file) != plan) {
            throw Error(ErrorCode::output,
                        fmt::format("{}: is another plan; --restart replaces it and removes its "
                                    "parts",
                                    file.string()));
        }
    }
    fs::create_directory(folder, failure);
    if (failure) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot write: {}", folder.string(), failure.message()));
    }
    for (const EngineFile& engine_file : files) {
        write_file(file_of_plan(engine_file.name, folder), engine_file.text);
    }
    if (plan.rates) {
        write_rates(file_of_plan(*plan.rates, folder));
    }
    write_file(file_of_plan(plan_name, folder), text);
}

}  // namespace bdpt::job
