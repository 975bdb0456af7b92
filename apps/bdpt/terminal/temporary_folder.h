#pragma once

#include <filesystem>
#include <string_view>

namespace bdpt::app {

/// A new folder for files that only this process reads. It is removed with its contents at the end.
class TemporaryFolder {
public:
    /// Throws `Error` (output) if it cannot be created.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    /// Returns the path of a file in the folder.
    [[nodiscard]] std::filesystem::path file(std::string_view name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

}  // namespace bdpt::app
