#pragma once

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt::io {

// What things of a scene take from when they are read until the last image [bytes], with what is
// built from them, beyond their descriptions. Measured by benchmarks/scale_table.py;
// tests/apps/files/memory_test.py holds them to it.

/// A document as values of JSON and structs of tinygltf, for each byte of its text.
constexpr std::uint64_t parsed_growth = 5;

/// Copies of corners and indices, what hits need, and Embree's tree.
constexpr std::uint64_t traced_triangle = 150;

/// Where its mesh is placed, and Embree's part of it.
constexpr std::uint64_t placed_instance = 500;

/// A pixel of an environment: in the description, in the light, where halves take less than this,
/// and in the table that it is sampled by.
constexpr std::uint64_t environment_pixel = sizeof(Rgb) + 2 * sizeof(float) + sizeof(std::uint16_t);

}  // namespace bdpt::io
