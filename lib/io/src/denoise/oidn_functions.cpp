#include "denoise/oidn_functions.h"

#include "file/companion.h"

#include <bdpt/error.h>

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <string>

namespace bdpt::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* library_name = "libOpenImageDenoise.so.2";

/// Returns the library of the Python package pyoidn, if this code is in a package beside it.
std::optional<fs::path> library_of_package()
{
#ifdef BDPT_IN_PYTHON_PACKAGE
    std::error_code error;
    const fs::path file = own_folder().parent_path() / "pyoidn" / "oidn" / "lib" / library_name;
    if (file.is_absolute() && fs::exists(file, error)) {
        return file;
    }
#endif
    return std::nullopt;
}

/// Returns the library that comes with this code, without symbolic links: it finds its parts
/// relative to itself.
std::optional<fs::path> library_beside()
{
    std::error_code error;
    const std::optional<fs::path> file =
        find_companion(std::string("denoiser/lib/") + library_name);
    return file ? std::optional(fs::canonical(*file, error)) : library_of_package();
}

std::string file_to_open(std::optional<fs::path> library)
{
    std::error_code error;
    const char* const chosen = std::getenv("BDPT_DENOISER");
    if (!library && chosen != nullptr) {
        library = chosen;
        if (library->empty()) {
            throw Error(ErrorCode::unsupported,
                        "no denoiser is looked for: BDPT_DENOISER is empty");
        }
    }
    if (!library) {
        return library_beside().value_or(library_name).string();
    }
    const fs::path file = fs::is_directory(*library, error) ? *library / library_name : *library;
    // A name without a slash would be searched in the system's folders.
    return fs::absolute(file, error).string();
}

template <typename Function>
void find(void* module, const std::string& file, const char* name, Function*& function)
{
    void* const address = dlsym(module, name);
    if (address == nullptr) {
        throw Error(ErrorCode::unsupported,
                    fmt::format("{} is not Open Image Denoise 2: it has no {}", file, name));
    }
    function = reinterpret_cast<Function*>(address);
}

}  // namespace

OidnFunctions open_oidn(const std::optional<fs::path>& library)
{
    const std::string file = file_to_open(library);
    // The library stays open: its threads may outlive our objects.
    void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (module == nullptr) {
        throw Error(
            ErrorCode::unsupported,
            fmt::format("no denoiser was found: {}. Open Image Denoise 2 is at "
                        "https://www.openimagedenoise.org, and in the Python package pyoidn",
                        dlerror()));
    }
    OidnFunctions functions{};
    find(module, file, "oidnNewDevice", functions.oidnNewDevice);
    find(module, file, "oidnSetDeviceInt", functions.oidnSetDeviceInt);
    find(module, file, "oidnGetDeviceInt", functions.oidnGetDeviceInt);
    find(module, file, "oidnCommitDevice", functions.oidnCommitDevice);
    find(module, file, "oidnGetDeviceError", functions.oidnGetDeviceError);
    find(module, file, "oidnReleaseDevice", functions.oidnReleaseDevice);
    find(module, file, "oidnNewFilter", functions.oidnNewFilter);
    find(module, file, "oidnSetSharedFilterImage", functions.oidnSetSharedFilterImage);
    find(module, file, "oidnSetFilterBool", functions.oidnSetFilterBool);
    find(module, file, "oidnCommitFilter", functions.oidnCommitFilter);
    find(module, file, "oidnExecuteFilter", functions.oidnExecuteFilter);
    find(module, file, "oidnReleaseFilter", functions.oidnReleaseFilter);
    return functions;
}

}  // namespace bdpt::io
