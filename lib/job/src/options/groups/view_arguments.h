#pragma once

#include <bdpt/framing.h>
#include <bdpt/io/gltf.h>
#include <bdpt/io/volume.h>
#include <bdpt/medium_desc.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>
#include <bdpt/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "options/option_list.h"
#include "options/value_types.h"

namespace bdpt::job {

/// Returns the camera of that name or index. Throws `Error` (not_found) with the list of those in
/// `file` if there is none.
[[nodiscard]] const CameraDesc& select_camera(std::span<const CameraDesc> cameras,
                                              const std::string& name_or_index,
                                              const std::string& file);

// The world of a scene has its own origin (`SceneDesc::origin`); users know the coordinates of the
// file.

/// Returns a point of the file in the world.
[[nodiscard]] inline Vec3 to_world(const DVec3& point, const DVec3& origin)
{
    return Vec3(point - origin);
}

/// Returns a point of the world in the coordinates of the file.
[[nodiscard]] inline DVec3 to_file(Vec3 point, const DVec3& origin)
{
    return DVec3(point) + origin;
}

/// Formats a point of the world as "x,y,z" in the coordinates of the file, with `digits` digits of
/// each, or nine along axes where the origin is distant.
[[nodiscard]] std::string place_text(Vec3 point, const DVec3& origin, int digits);

/// User's changes of a view.
struct ViewOverrides {
    std::optional<DVec3> from{};          ///< [m], in coordinates of the file
    std::optional<DVec3> look_at{};       ///< [m], in coordinates of the file
    std::optional<float> vertical_fov{};  ///< [rad]
    // Options of a view that frames the whole scene.
    std::optional<ViewDirection> direction{};
    std::optional<float> margin{};
    Projection projection = Projection::perspective;

    [[nodiscard]] bool any() const { return from || look_at || vertical_fov || frames(); }
    /// Tests whether the whole scene is to be framed, whatever cameras it has.
    [[nodiscard]] bool frames() const
    {
        return direction || margin || projection == Projection::orthographic;
    }
};

/// Returns `camera` with `overrides`. `camera` and `target` are in the world, whose origin in the
/// file is `origin`. A camera that is moved without a `look_at` keeps its direction or, given
/// `target`, turns to it. Throws `Error` (usage) if it would look at itself, or has no field of
/// view to change.
[[nodiscard]] CameraDesc apply(const ViewOverrides& overrides, const CameraDesc& camera,
                               const std::optional<Vec3>& target, const DVec3& origin = DVec3(0.0));

/// Returns the largest size within 1280 x 720 with the camera's aspect ratio; 1280 x 720 if it has
/// none.
[[nodiscard]] Size default_size(const std::optional<float>& aspect_ratio);

/// Adds --camera, stored in `camera`, and the options that change or frame a view.
void add_camera_options(OptionList& options, std::optional<std::string>& camera,
                        ViewOverrides& view);

/// Returns the options of a view, with its lens, that exclude each other. Those that frame the
/// scene exclude --camera, unless its value is auto.
[[nodiscard]] std::vector<Conflict> view_conflicts();

/// Throws `OptionError` if the given options of a view are incompatible.
void check_camera_options(const OptionList& options, const std::optional<std::string>& camera);

/// Lens of a view.
struct LensChoice {
    std::optional<double> radius{};          ///< [m]
    std::optional<double> f_stop{};          ///< focal length over diameter
    std::optional<double> focus_distance{};  ///< [m]
};

/// Adds --lens-radius, --f-stop and --focus-distance.
void add_lens_options(OptionList& options, LensChoice& lens);

/// Returns `camera` with `lens`. If neither `lens` nor the camera's own lens has a focus distance,
/// it focuses on the surface in the middle of the view of `scene`. Throws `Error` (usage) if there
/// is none, or if the camera cannot have a lens.
[[nodiscard]] CameraDesc with_lens(const LensChoice& lens, CameraDesc camera, const Scene& scene,
                                   const Size& size);

/// Returns the point that a camera orbits: `look_at` or, without it, the point of its view axis
/// nearest to the `middle` of the scene [m]. Throws `Error` (usage) if it is not in front of the
/// camera.
[[nodiscard]] Vec3 orbit_center(const CameraDesc& camera, const std::optional<Vec3>& look_at,
                                Vec3 middle);

/// Adds --scene, --variant, --frame-time, --animation and --shutter, which select the part of a
/// file to load, --ktx-library, --allow-folder, --ignore-required and --strict, which control
/// loading, and
/// --max-memory [bytes].
void add_scene_options(OptionList& options, io::GltfOptions& scene,
                       std::optional<std::uint64_t>& max_memory);

/// Changes of a scene's environment, whatever its source.
struct EnvironmentChange {
    double rotation = 0.0;   ///< about +y, counter-clockwise as seen from above [deg]
    float intensity = 1.0f;  ///< factor of the radiance, >= 0

    [[nodiscard]] bool operator==(const EnvironmentChange&) const = default;
};

/// Adds --env-rotation and --env-intensity.
void add_environment_options(OptionList& options, EnvironmentChange& change);

/// A volume of an OpenVDB file to put into the scene.
struct VolumeChoice {
    std::filesystem::path file{};
    io::VolumeOptions options{};  ///< without limits
};

/// Adds --fog, --fog-albedo and --fog-anisotropy.
void add_fog_options(OptionList& options, MediumDesc& fog);

/// Adds --volume and the options whose names begin with it.
void add_volume_options(OptionList& options, VolumeChoice& volume);

/// Throws `OptionError` if one of them is given without --fog or --volume.
void check_medium_options(const OptionList& options);

}  // namespace bdpt::job
