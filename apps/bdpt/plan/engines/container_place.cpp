#include "plan/engines/container_place.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

fs::path common_folder(const fs::path& a, const fs::path& b)
{
    fs::path result;
    const auto [end, ignored] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    for (auto name = a.begin(); name != end; ++name) {
        result /= *name;
    }
    return result;
}

}  // namespace

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

}  // namespace bdpt::app
