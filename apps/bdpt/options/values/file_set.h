#pragma once

#include <sys/types.h>

#include <filesystem>
#include <set>
#include <utility>
#include <vector>

namespace bdpt::app {

/// A set of files by identity, existing or not: links, hard links and other spellings of a name
/// count as the same file.
class FileSet {
public:
    FileSet() = default;
    FileSet(const std::vector<std::filesystem::path>& files) { add(files); }

    /// Adds a file; returns true if it was not in the set before.
    bool add(const std::filesystem::path& file);
    void add(const std::vector<std::filesystem::path>& files);
    [[nodiscard]] bool contains(const std::filesystem::path& file) const;

private:
    std::set<std::pair<dev_t, ino_t>> there_;
    std::set<std::filesystem::path> not_there_;
};

/// Tests whether `file`, existing or not, is in `folder` or below, with symbolic links followed.
[[nodiscard]] bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace bdpt::app
