#include "plan/planned_identity.h"

#include <bdpt/io/file_contents.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

namespace bdpt::app {
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
        const bool is_own = std::find(own.begin(), own.end(), component.name) != own.end();
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

}  // namespace bdpt::app
