#include "file/companion.h"

#include <bdpt/error.h>

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <system_error>

namespace bdpt::io {

namespace {

/// Returns the library that contains this code, or the program that it is linked into.
std::filesystem::path own_file()
{
    Dl_info info{};
    link_map* loaded = nullptr;
    const bool known = dladdr1(reinterpret_cast<const void*>(&own_file), &info,
                               reinterpret_cast<void**>(&loaded), RTLD_DL_LINKMAP) != 0;
    // The loader has no name for the program itself, and the name that the program was called by
    // could denote any file in the current folder.
    const bool is_library = known && loaded != nullptr && loaded->l_name[0] != '\0';
    return is_library ? loaded->l_name : "/proc/self/exe";
}

}  // namespace

std::filesystem::path own_folder()
{
    std::error_code error;
    return std::filesystem::canonical(own_file(), error).parent_path();
}

std::optional<std::filesystem::path> find_companion(std::string_view name)
{
    std::error_code error;
    const std::filesystem::path here = own_folder();
    for (const char* folder : {BDPT_COMPANION_FOLDERS}) {  // the most likely folder first
        const std::filesystem::path file = here / folder / name;
        if (here.is_absolute() && std::filesystem::exists(file, error)) {
            return file;
        }
    }
    return std::nullopt;
}

std::filesystem::path companion_file(std::string_view name)
{
    if (const std::optional<std::filesystem::path> file = find_companion(name)) {
        return *file;
    }
    std::string tried;
    for (const char* folder : {BDPT_COMPANION_FOLDERS}) {
        const std::filesystem::path file = own_folder() / folder / name;
        tried += (tried.empty() ? "" : ", ") + file.lexically_normal().string();
    }
    throw Error(ErrorCode::unsupported, fmt::format("{} not found (tried {})", name, tried));
}

}  // namespace bdpt::io
