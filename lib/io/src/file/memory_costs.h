#pragma once

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt::io {

// Memory [bytes] of parts of a scene, from reading until the last image, with all that is built
// from them, beyond their descriptions. Measured by benchmarks/scale_table.py; checked by
// tests/apps/files/memory_test.py.

/// A document as JSON values and structs of tinygltf, per byte of its text.
constexpr std::uint64_t parsed_growth = 5;

/// Copies of corners and indices, data for hits, and Embree's BVH.
constexpr std::uint64_t traced_triangle = 150;

/// Placement of a mesh, and Embree's part of it.
constexpr std::uint64_t placed_instance = 500;

/// A pixel of an environment of floats: in the description, in the light (where halves take less
/// than this), and in its sampling table.
constexpr std::uint64_t environment_pixel = sizeof(Rgb) + 2 * sizeof(float) + sizeof(std::uint16_t);

/// A pixel of an environment of halves, which description and light share, and in its table.
constexpr std::uint64_t compact_environment_pixel =
    3 * sizeof(std::uint16_t) + sizeof(std::uint16_t);

}  // namespace bdpt::io
