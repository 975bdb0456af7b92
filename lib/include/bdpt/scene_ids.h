#pragma once

#include <cstdint>

namespace bdpt {

/// Indices into the vectors of `SceneDesc`; as types, so that one cannot stand for another.
enum class MeshId : std::uint32_t {};
enum class MaterialId : std::uint32_t {};
enum class ImageId : std::uint32_t {};
enum class ProfileId : std::uint32_t {};

}  // namespace bdpt
