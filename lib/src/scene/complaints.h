#pragma once

#include "geometry/reach.h"

#include <bdpt/error.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>

namespace bdpt {

/// Throws `Error` (invalid_input) whose message is all parts in a row.
template <typename... Parts>
[[noreturn]] void fail(const Parts&... parts)
{
    std::ostringstream message;
    (message << ... << parts);
    throw Error(ErrorCode::invalid_input, message.str());
}

/// `mesh 3 "chair"`
[[nodiscard]] inline std::string label(std::string_view kind, std::size_t index,
                                       const std::string& name)
{
    std::string text = std::string(kind) + " " + std::to_string(index);
    return name.empty() ? text : text + " \"" + name + "\"";
}

/// How far things may be, and why.
[[nodiscard]] inline std::string reach_text(float reach)
{
    std::ostringstream text;
    text << " m from the origin, but " << reach << " m is the most";
    if (reach < greatest_reach) {
        text << ", as a mesh that is used more than once or moves is scaled down very much";
    }
    return text.str();
}

/// Checks all that moves in a scene that is valid when the shutter opens; `reach` as in
/// geometry/reach.h. Throws `Error` (invalid_input).
void check_motion(const SceneDesc& desc, float reach);

}  // namespace bdpt
