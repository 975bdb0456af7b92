#pragma once

#include <bdpt/io/memory_budget.h>
#include <bdpt/scene_desc.h>

#include <cstdint>

namespace bdpt::app {

/// Number of copies of a description while a scene is built from it.
enum class Copies : std::uint8_t { one = 1, two = 2 };

/// Charges the memory of building a scene beyond that of loading: mipmaps, the light tree, a second
/// copy of all that was loaded. Throws `Error` if that is too much.
void spend_building(io::MemoryBudget& memory, const SceneDesc& scene, Copies copies);

}  // namespace bdpt::app
