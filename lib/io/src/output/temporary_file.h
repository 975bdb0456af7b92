#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "output/output_target.h"

namespace bdpt::io {

/// Returns host, process number and 16 random digits, which distinguish this process from all
/// others that may write to the same folder. The number alone does not: processes in two
/// containers, or on two machines, may share it.
[[nodiscard]] const std::string& process_name();

/// Returns the path at which the file `target` grows: in its folder, named after it and the
/// process. In a name too long for the file system the part from `target` is truncated.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& target);

struct TemporaryFile {
    int descriptor = -1;  ///< -1: errno tells why there is none
    std::filesystem::path path;
};

/// Creates a new file, called `name`, with the access rights of the file that it will replace, if
/// any. If `name` is taken, as by another `OutputFile` of this process for the same target, a
/// number is appended.
[[nodiscard]] TemporaryFile create_temporary(const std::filesystem::path& name,
                                             const std::optional<FileAccess>& access);

}  // namespace bdpt::io
