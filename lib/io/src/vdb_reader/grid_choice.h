#pragma once

#include <openvdb/openvdb.h>

#include <cstddef>
#include <string>

namespace bdpt::vdb {

/// `text` as it may stand in a message: of one line, and of `most` characters.
[[nodiscard]] std::string plain(const std::string& text, std::size_t most = 80);

/// The start of messages about a grid.
[[nodiscard]] std::string label(const openvdb::GridBase& grid);

/// The name, unique in `file`, of the grid that is meant: the one named `wanted` or, if that is
/// empty, "density", else the only one of floats. All that its head tells has been checked. Throws
/// `Error` (invalid_input, unsupported).
[[nodiscard]] std::string chosen_grid(openvdb::io::File& file, const std::string& wanted);

}  // namespace bdpt::vdb
