#pragma once

#include <string>

namespace bdpt::vdb {

/// Checks what OpenVDB does not: that the file is of no newer version than it knows, and that no
/// grid goes on behind the end of the file, which is read as zeros. Throws `Error` (invalid_input,
/// unsupported), or what OpenVDB does for broken heads of grids. `openvdb::initialize()` was
/// called.
void check_whole_file(const std::string& name);

}  // namespace bdpt::vdb
