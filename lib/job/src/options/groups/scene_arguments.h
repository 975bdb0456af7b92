#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/io/volume.h>
#include <bdpt/medium_desc.h>

#include <cstdint>
#include <filesystem>
#include <optional>

#include "options/option_list.h"

namespace bdpt::job {

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
