#include "gltf/document/selection.h"
#include "gltf/scene/scene_builder.h"

namespace bdpt::io {

std::optional<std::size_t> select_scene(const Json& document,
                                        const std::optional<std::string>& wanted)
{
    const std::vector<std::string> names =
        names_in(array_at(document, Json::json_pointer("/scenes")));
    if (wanted) {
        return select("scene", names, *wanted);
    }
    if (document.contains("scene")) {
        return document["scene"].get<std::size_t>();
    }
    return names.empty() ? std::nullopt : std::optional<std::size_t>(0);
}

}  // namespace bdpt::io
