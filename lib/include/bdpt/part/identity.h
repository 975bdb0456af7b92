#pragma once

#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <optional>
#include <string>
#include <vector>

namespace bdpt {

class Scene;
struct CameraDesc;

/// One thing that the bits of a render depend on.
struct IdentityComponent {
    std::string name;   ///< "scene: images[3]", "camera: lens radius", "option: max_depth"
    std::string value;  ///< the value itself, or '#' and a hash of it
    [[nodiscard]] bool operator==(const IdentityComponent&) const = default;
};

/// All that the bits of a sample depend on but its index. Samples of the same identity add up to
/// one render, wherever they were made.
struct Identity {
    std::vector<IdentityComponent> components;
    [[nodiscard]] bool operator==(const Identity&) const = default;
};

/// That of a render. Not in it is what changes no bit: the samples that are asked for, threads,
/// tiles, limits of memory; names only where images of ids show them.
[[nodiscard]] BDPT_EXPORT Identity identity(const Scene& scene, const CameraDesc& camera,
                                            const RenderOptions& options);

/// In what `there` differs, such as "option: max_depth (8, not 4)" where it has 8 and `here` has
/// 4; at most three of these. None if the identities are equal.
[[nodiscard]] BDPT_EXPORT std::optional<std::string> difference(const Identity& here,
                                                                const Identity& there);

}  // namespace bdpt
