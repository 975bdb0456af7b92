#pragma once

#include <bdpt/framing.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <optional>
#include <span>
#include <string>

#include "options/arguments.h"

namespace bdpt::app {

/// The camera that `name_or_index` means. Throws `Error` (not_found) with the list of those in
/// `file` when there is none.
[[nodiscard]] const CameraDesc& select_camera(std::span<const CameraDesc> cameras,
                                              const std::string& name_or_index,
                                              const std::string& file);

/// What the user wants changed in a view.
struct ViewOverrides {
    std::optional<Vec3> from{};           ///< [m]
    std::optional<Vec3> look_at{};        ///< [m]
    std::optional<float> vertical_fov{};  ///< [rad]
    // Of a view that frames the whole scene.
    std::optional<ViewDirection> direction{};
    std::optional<float> margin{};
    Projection projection = Projection::perspective;

    [[nodiscard]] bool any() const { return from || look_at || vertical_fov || frames(); }
    /// Is the whole scene to be framed, whatever cameras it has?
    [[nodiscard]] bool frames() const
    {
        return direction || margin || projection == Projection::orthographic;
    }
};

/// `camera` with `overrides`. A camera that is moved without a word on where to look keeps its
/// direction or, given `target`, turns to that. Throws `Error` (usage) when it would look at
/// itself, or has no field of view to change.
[[nodiscard]] CameraDesc apply(const ViewOverrides& overrides, const CameraDesc& camera,
                               const std::optional<Vec3>& target);

/// The largest image in 1280 x 720 with the camera's aspect ratio; 1280 x 720 if it has none.
[[nodiscard]] Size default_size(const std::optional<float>& aspect_ratio);

}  // namespace bdpt::app
