#include "file/uri.h"
#include "gltf/scene_builder.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <system_error>

namespace bdpt::io {

namespace {

std::string name_of(const Json& scene)
{
    const auto name = scene.find("name");
    return name != scene.end() && name->is_string() ? name->get<std::string>() : std::string();
}

std::string list(const Json& scenes)
{
    if (scenes.empty()) {
        return "there are none";
    }
    std::string text = "there are";
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const std::string name = name_of(scenes[i]);
        text += fmt::format("{} {}", i == 0 ? "" : ",", i);
        if (!name.empty()) {
            text += fmt::format(" {}", quote(name));
        }
    }
    return text;
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

std::optional<std::size_t> select_scene(const Json& document,
                                        const std::optional<std::string>& wanted)
{
    const Json scenes = document.contains("scenes") ? document["scenes"] : Json::array();
    if (!wanted) {
        if (document.contains("scene")) {
            return document["scene"].get<std::size_t>();
        }
        return scenes.empty() ? std::nullopt : std::optional<std::size_t>(0);
    }
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        if (name_of(scenes[i]) == *wanted) {
            return i;
        }
    }
    const std::optional<std::size_t> index = to_index(*wanted);
    if (!index || *index >= scenes.size()) {
        throw Error(ErrorCode::not_found,
                    fmt::format("no scene {}; {}", quote(*wanted), list(scenes)));
    }
    return index;
}

}  // namespace bdpt::io
