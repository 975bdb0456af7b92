#pragma once

#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <cstdint>
#include <string>

namespace bdpt {

/// Formats bytes as "12 MB", rounded up, for messages.
[[nodiscard]] inline std::string megabytes(std::uint64_t bytes)
{
    constexpr std::uint64_t megabyte = 1'000'000;
    return std::to_string(bytes / megabyte + (bytes % megabyte != 0 ? 1 : 0)) + " MB";
}

/// Throws `Error` (usage) if `value` is not in [low, high]; the text begins with `what`.
void check_range(const char* what, std::int64_t value, std::int64_t low, std::int64_t high);

/// Throws `Error` (usage) that names the first option out of range and its value.
void check_options(const RenderOptions& options);

/// Throws `Error` (usage) for integrators that do not support rates: lt, whose pixels take no
/// samples of their own, and vcm, whose merge radius belongs to a sample index.
void check_takes_rates(IntegratorKind integrator);

/// Throws `Error` (invalid_input) if the camera has no usable view.
void check_camera(const CameraDesc& camera);

/// Throws `Error` (invalid_input) if the camera, during its motion, is farther than that from the
/// origin [m], in any coordinate: its rays would hit nothing.
void check_camera_distance(const CameraDesc& camera, float farthest);

/// Throws `Error` (usage) if numbers of light paths or connections are out of range or
/// inconsistent, or if shared light paths could take more than `light_path_memory`. All other
/// options have been checked.
void check_light_paths(const RenderOptions& options);

}  // namespace bdpt
