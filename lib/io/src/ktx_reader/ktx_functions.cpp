#include "ktx_reader/ktx_functions.h"

#include <bdpt/error.h>

#include <dlfcn.h>

#include <filesystem>
#include <system_error>
#include <vector>

namespace bdpt::ktx {
namespace {

namespace fs = std::filesystem;

/// Names of the library in packages, and in builds without a version.
constexpr const char* library_names[] = {"libktx.so.4", "libktx.so"};

std::vector<std::string> files_to_try(const std::string& library)
{
    if (library.empty()) {
        return {library_names[0], library_names[1]};
    }
    std::error_code error;
    // A name without a slash would be searched in the system's folders.
    const fs::path path = fs::absolute(library, error);
    if (!fs::is_directory(path, error)) {
        return {path.string()};
    }
    return {(path / library_names[0]).string(), (path / library_names[1]).string()};
}

template <typename Function>
void find(void* module, const std::string& file, const char* name, Function*& function)
{
    void* const address = dlsym(module, name);
    if (address == nullptr) {
        throw Error(ErrorCode::unsupported, file + " is not libktx 4: it has no " + name);
    }
    function = reinterpret_cast<Function*>(address);
}

}  // namespace

KtxFunctions open_ktx(const std::string& library)
{
    std::string reason;
    for (const std::string& file : files_to_try(library)) {
        void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (module == nullptr) {
            reason = reason.empty() ? dlerror() : reason;  // the error of the likelier name
            continue;
        }
        KtxFunctions functions{};
        find(module, file, "ktxTexture2_CreateFromMemory", functions.ktxTexture2_CreateFromMemory);
        find(module, file, "ktxTexture2_NeedsTranscoding", functions.ktxTexture2_NeedsTranscoding);
        find(module, file, "ktxTexture2_TranscodeBasis", functions.ktxTexture2_TranscodeBasis);
        find(module, file, "ktxTexture_GetData", functions.ktxTexture_GetData);
        find(module, file, "ktxTexture_GetDataSize", functions.ktxTexture_GetDataSize);
        find(module, file, "ktxErrorString", functions.ktxErrorString);
        return functions;
    }
    throw Error(ErrorCode::unsupported,
                "libktx was not found: " + reason +
                    ". libktx 4 is part of https://github.com/KhronosGroup/KTX-Software");
}

}  // namespace bdpt::ktx
