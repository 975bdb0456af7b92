#pragma once

#include <bdpt/types.h>

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt::io {

/// Interpretation of integers in an accessor.
enum class Integers : std::uint8_t {
    as_declared,  ///< by the accessor's `normalized`
    normalized,   ///< fractions of the greatest value [glTF 2.0, sec. 3.6.2.2]
    whole,        ///< unscaled
};

/// Reads the elements of an accessor, with sparse ones applied [glTF 2.0, sec. 3.6.2.3]. V is Vec2,
/// Vec3 or Vec4 and must be the accessor's type. Relies on check_layout. Throws `Error`
/// (invalid_input).
template <typename V>
[[nodiscard]] std::vector<V> read_vectors(const tinygltf::Model& model, int accessor,
                                          Integers integers = Integers::as_declared);

/// Reads the components of all elements of an accessor, whose type must be `type` (of tinygltf) and
/// have no padding. Relies on check_layout. Throws `Error` (invalid_input).
[[nodiscard]] std::vector<float> read_numbers(const tinygltf::Model& model, int accessor, int type,
                                              Integers integers = Integers::as_declared);

/// Reads the elements of an accessor of unsigned scalars. Throws `Error` (invalid_input).
[[nodiscard]] std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor);

}  // namespace bdpt::io
