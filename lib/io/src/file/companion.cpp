#include "file/companion.h"

#include <bdpt/error.h>

#include <dlfcn.h>
#include <fmt/format.h>

#include <system_error>

namespace bdpt::io {

namespace {

/// The folder of the program or library that holds this code.
std::filesystem::path own_folder()
{
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&own_folder), &info) == 0 ||
        info.dli_fname == nullptr) {
        return {};
    }
    std::error_code error;
    // For a program it may be the word it was called by, so ask the system.
    const std::filesystem::path named = std::filesystem::weakly_canonical(info.dli_fname, error);
    if (!error && std::filesystem::exists(named, error)) {
        return named.parent_path();
    }
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

}  // namespace

std::filesystem::path companion_file(std::string_view name)
{
    const std::filesystem::path here = own_folder();
    std::string tried;
    for (const char* folder : {BDPT_COMPANION_FOLDERS}) {         // the most likely place first
        const std::filesystem::path file = here / folder / name;  // `here` counts if it is relative
        std::error_code error;
        if (std::filesystem::exists(file, error)) {
            return file;
        }
        tried += (tried.empty() ? "" : ", ") + file.lexically_normal().string();
    }
    throw Error(ErrorCode::unsupported, fmt::format("{} is not there (tried {})", name, tried));
}

}  // namespace bdpt::io
