#pragma once

#include <cstdint>

namespace bdpt {

/// Index into `SceneDesc::meshes`. Each kind of index has a type of its own, so that they cannot be
/// confused.
enum class MeshId : std::uint32_t {};
/// Index into `SceneDesc::materials`.
enum class MaterialId : std::uint32_t {};
/// Index into `SceneDesc::images`.
enum class ImageId : std::uint32_t {};
/// Index into `SceneDesc::profiles`.
enum class ProfileId : std::uint32_t {};

}  // namespace bdpt
