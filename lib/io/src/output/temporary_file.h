#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "output/output_target.h"

namespace bdpt::io {

/// Host, process number and 16 random digits. They tell this process from all others that may write
/// to the same folder. Its number does not: processes of two containers, or of two machines, may
/// have the same.
[[nodiscard]] const std::string& process_name();

/// Where the file `target` grows: beside it, called after it and the process. A name that would be
/// too long for the file system loses the end of what it has of `target`.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& target);

struct TemporaryFile {
    int descriptor = -1;  ///< -1: errno tells why there is none
    std::filesystem::path path;
};

/// A new file, called `name`, for those who may use the file that it will replace, if there is one.
/// If `name` is taken, as by another `OutputFile` of this process for the same target, it gets a
/// number.
[[nodiscard]] TemporaryFile create_temporary(const std::filesystem::path& name,
                                             const std::optional<FileAccess>& access);

}  // namespace bdpt::io
