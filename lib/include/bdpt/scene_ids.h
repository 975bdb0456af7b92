#pragma once

/// @file
/// Gives the indices of meshes, materials, images and light profiles types of their own.
///
/// @code{.cpp}
/// std::string name_of_material(const bdpt::SceneDesc& desc, bdpt::MaterialId id)
/// {
///     return desc.materials.at(static_cast<std::size_t>(id)).name;
/// }
/// @endcode

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
