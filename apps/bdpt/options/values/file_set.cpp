#include "options/values/file_set.h"

#include <bdpt/io/output_file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <optional>
#include <system_error>

#include "options/values/pipes.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

/// Returns device and inode of a file; none: it does not exist.
std::optional<std::pair<dev_t, ino_t>> find_identity(const fs::path& file)
{
    struct stat status{};
    const int result =
        is_standard_output(file) ? ::fstat(STDOUT_FILENO, &status) : ::stat(file.c_str(), &status);
    return result == 0 ? std::optional(std::pair(status.st_dev, status.st_ino)) : std::nullopt;
}

/// Returns the resolved path of a file that does not exist.
fs::path resolve_path(const fs::path& file)
{
    if (is_standard_output(file)) {
        return "-";
    }
    std::error_code missing;
    return fs::weakly_canonical(fs::absolute(io::follow_links(file), missing), missing);
}

}  // namespace

bool FileSet::add(const fs::path& file)
{
    const auto identity = find_identity(file);
    return identity ? there_.insert(*identity).second
                    : not_there_.insert(resolve_path(file)).second;
}

void FileSet::add(const std::vector<fs::path>& files)
{
    for (const fs::path& file : files) {
        static_cast<void>(add(file));
    }
}

bool FileSet::contains(const fs::path& file) const
{
    const auto identity = find_identity(file);
    return identity ? there_.contains(*identity) : not_there_.contains(resolve_path(file));
}

bool is_below(const fs::path& file, const fs::path& folder)
{
    const fs::path way = resolve_path(file).lexically_relative(resolve_path(folder / "."));
    return !way.empty() && way != "." && *way.begin() != "..";
}

}  // namespace bdpt::app
