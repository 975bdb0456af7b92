#pragma once

/// @file
/// Tells whether samples belong to the same render.
///
/// @code{.cpp}
/// void print_difference(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     const bdpt::Identity here = bdpt::identity(scene, camera, {});
///     const bdpt::Identity there = bdpt::identity(scene, camera, {.sampling = {.seed = 1}});
///     if (const auto difference = bdpt::difference(here, there)) {
///         std::cout << "another render: " << *difference << '\n';
///     }
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <optional>
#include <string>
#include <vector>

namespace bdpt {

class Scene;
struct CameraDesc;

/// One input that the bits of a render depend on.
struct IdentityComponent {
    std::string name;   ///< "scene: images[3]", "camera: lens radius", "option: max_depth"
    std::string value;  ///< the value itself, or '#' and its hash
    [[nodiscard]] bool operator==(const IdentityComponent&) const = default;
};

/// Everything that the bits of a sample depend on, except its index. Samples of the same identity
/// add up to one render, wherever they were computed.
struct Identity {
    std::vector<IdentityComponent> components;
    [[nodiscard]] bool operator==(const Identity&) const = default;
};

/// Returns the identity of a render. It excludes everything that changes no bit: the requested
/// samples, threads, tiles and memory limits; it includes names only if id images show them.
[[nodiscard]] BDPT_EXPORT Identity identity(const Scene& scene, const CameraDesc& camera,
                                            const RenderOptions& options);

/// Describes how `there` differs from `here`, such as "option: max_depth (8, not 4)" where `there`
/// has 8 and `here` has 4; lists at most three differences. Returns nullopt if the identities are
/// equal.
[[nodiscard]] BDPT_EXPORT std::optional<std::string> difference(const Identity& here,
                                                                const Identity& there);

}  // namespace bdpt
