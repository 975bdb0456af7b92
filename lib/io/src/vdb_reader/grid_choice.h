#pragma once

#include <openvdb/openvdb.h>

#include <cstddef>
#include <string>

namespace bdpt::vdb {

/// Returns `text` for a message: on one line, and of up to `most` characters.
[[nodiscard]] std::string plain(const std::string& text, std::size_t most = 80);

/// Returns the start of messages about a grid.
[[nodiscard]] std::string label(const openvdb::GridBase& grid);

/// Returns the name, unique in `file`, of the chosen grid: the one named `wanted` or, if that is
/// empty, "density", else the only one of floats. All that its header tells has been checked.
/// Throws `Error` (invalid_input, unsupported).
[[nodiscard]] std::string chosen_grid(openvdb::io::File& file, const std::string& wanted);

}  // namespace bdpt::vdb
