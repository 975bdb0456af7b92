#pragma once

#include <bdpt/io/memory_budget.h>
#include <bdpt/scene_desc.h>

#include <cstdint>

namespace bdpt::app {

/// How many copies of a description there are while a scene is built from it.
enum class Copies : std::uint8_t { one = 1, two = 2 };

/// Takes what building a scene needs beyond what its loading has taken: smaller copies of images,
/// the light tree, a second copy of all that was loaded. Throws `Error` if that is too much.
void spend_building(io::MemoryBudget& memory, const SceneDesc& scene, Copies copies);

}  // namespace bdpt::app
