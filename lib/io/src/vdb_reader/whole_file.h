#pragma once

#include <string>

namespace bdpt::vdb {

/// Checks what OpenVDB does not: that the file's version is not newer than the library's, and that
/// no grid extends behind the end of the file, which would be read as zeros. Throws `Error`
/// (invalid_input, unsupported), or what OpenVDB does for broken headers of grids.
/// `openvdb::initialize()` was called.
void check_whole_file(const std::string& name);

}  // namespace bdpt::vdb
