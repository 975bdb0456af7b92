#pragma once

#include <filesystem>
#include <string_view>

namespace bdpt::app {

/// A new folder for files that only this process reads. It is removed at the end, with all that is
/// in it.
class TemporaryFolder {
public:
    /// Throws `Error` (output) if there can be none.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    /// The path of a file in it.
    [[nodiscard]] std::filesystem::path file(std::string_view name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

}  // namespace bdpt::app
