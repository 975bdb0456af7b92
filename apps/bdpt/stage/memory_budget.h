#pragma once

#include <cstdint>

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// What the film takes of --max-memory [bytes]; 0 without a limit. Throws `Error` (invalid_input)
/// when that is all of it.
[[nodiscard]] std::uint64_t reserved_bytes(const RenderArguments& arguments);

/// Loads the scene into the memory that the film leaves. Throws what `prepare_scene` does.
[[nodiscard]] PreparedScene prepare_within_memory(RenderArguments arguments);

}  // namespace bdpt::app
