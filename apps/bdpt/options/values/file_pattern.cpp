#include "options/values/file_pattern.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "options/arguments.h"
#include "options/option_list.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view camera_place = "{camera}";
constexpr std::string_view scene_place = "{name}";

std::string as_file_name(std::string word)
{
    for (std::size_t i = 0; i < word.size(); ++i) {
        const auto c = static_cast<unsigned char>(word[i]);
        const bool special = c < 0x20 || c == 0x7f || c == '/' || c == '\\' || c == ':';
        if (special || (i == 0 && c == '.')) {
            word[i] = '_';
        }
    }
    return word;
}

/// Replaces `place` by `word` in the name of `file`.
fs::path with_word(const fs::path& file, std::string_view place, const std::string& word)
{
    std::string name = file.filename().string();
    const std::string replacement = as_file_name(word);
    for (std::size_t at = name.find(place); at != std::string::npos;
         at = name.find(place, at + replacement.size())) {
        name.replace(at, place.size(), replacement);
    }
    return file.parent_path() / name;
}

}  // namespace

bool takes_number(const fs::path& file)
{
    return file.filename().string().find('#') != std::string::npos;
}

fs::path with_number(const fs::path& file, int number)
{
    std::string name = file.filename().string();
    const std::size_t begin = name.find('#');
    if (begin == std::string::npos) {
        return file;
    }
    const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
    if (name.find('#', end) != std::string::npos) {
        throw OptionError(fmt::format(
            "{}: expected one run of # in the name, for the frame number", file.string()));
    }
    const std::string digits =
        fmt::format("{}{:0{}}", number < 0 ? "-" : "", std::abs(std::int64_t{number}), end - begin);
    return file.parent_path() / name.replace(begin, end - begin, digits);
}

bool takes_camera(const fs::path& file)
{
    return file.filename().string().find(camera_place) != std::string::npos;
}

fs::path with_camera(const fs::path& file, const std::string& camera)
{
    return with_word(file, camera_place, camera);
}

fs::path with_scene(const fs::path& file, const std::string& name)
{
    return with_word(file, scene_place, name);
}

}  // namespace bdpt::app
