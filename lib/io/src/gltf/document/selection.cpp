#include "gltf/document/selection.h"

#include "file/uri.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

namespace bdpt::io {

namespace {

/// Returns a list such as "the file has 2 scenes: 0 "day", 1 "night"".
std::string list(std::string_view what, const std::vector<std::string>& names)
{
    constexpr std::size_t max_listed = 20;
    if (names.empty()) {
        return fmt::format("the file has no {}s", what);
    }
    std::string text = names.size() == 1 ? fmt::format("the file has one {}:", what)
                                         : fmt::format("the file has {} {}s:", names.size(), what);
    for (std::size_t i = 0; i < std::min(names.size(), max_listed); ++i) {
        text += fmt::format("{} {}", i == 0 ? "" : ",", i);
        if (!names[i].empty()) {
            text += fmt::format(" {}", quote(names[i]));
        }
    }
    return names.size() > max_listed ? text + fmt::format(" and {} more", names.size() - max_listed)
                                     : text;
}

std::optional<std::size_t> to_index(std::string_view text)
{
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size()) {
        return std::nullopt;
    }
    return index;
}

}  // namespace

std::vector<std::string> names_in(const Json& array)
{
    std::vector<std::string> names;
    if (!array.is_array()) {
        return names;
    }
    for (const Json& element : array) {
        const auto name = element.find("name");
        names.push_back(name != element.end() && name->is_string() ? name->get<std::string>()
                                                                   : std::string());
    }
    return names;
}

const Json& array_at(const Json& document, const Json::json_pointer& path)
{
    static const Json none;
    return document.contains(path) ? document.at(path) : none;
}

std::size_t select(std::string_view what, const std::vector<std::string>& names,
                   const std::string& wanted)
{
    const auto named = std::find(names.begin(), names.end(), wanted);
    if (named != names.end() && !wanted.empty()) {
        return static_cast<std::size_t>(named - names.begin());
    }
    const std::optional<std::size_t> index = to_index(wanted);
    if (!index || *index >= names.size()) {
        throw Error(ErrorCode::not_found,
                    fmt::format("no {} {}; {}", what, quote(wanted), list(what, names)));
    }
    return *index;
}

}  // namespace bdpt::io
