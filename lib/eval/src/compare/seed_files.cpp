#include <bdpt/error.h>
#include <bdpt/eval/comparison.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <system_error>

namespace bdpt::eval {
namespace {

namespace fs = std::filesystem;

bool is_image(const fs::directory_entry& entry)
{
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::error_code ignored;
    return entry.is_regular_file(ignored) && (extension == ".exr" || extension == ".hdr") &&
           !entry.path().filename().string().starts_with(".");
}

bool same_file(const fs::path& a, const fs::path& b)
{
    std::error_code missing;
    return fs::equivalent(a, b, missing);
}

}  // namespace

std::vector<fs::path> seed_files(const fs::path& path, const fs::path& reference)
{
    std::error_code failure;
    if (!fs::is_directory(path, failure)) {
        return {path};
    }
    std::vector<fs::path> files;
    for (auto entry = fs::directory_iterator(path, failure);
         !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
        if (is_image(*entry) && !same_file(entry->path(), reference)) {
            files.push_back(entry->path());
        }
    }
    if (failure) {
        throw Error(ErrorCode::not_found, path.string() + ": " + failure.message());
    }
    if (files.empty()) {
        throw Error(ErrorCode::not_found, path.string() +
                                              ": the folder has no .exr or .hdr file beside the "
                                              "reference");
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace bdpt::eval
