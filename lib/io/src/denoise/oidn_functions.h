#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>

namespace bdpt::io {

/// The used part of the C interface of Open Image Denoise 2, by the names of its documentation.
/// Handles are opaque pointers, enumerators plain numbers.
struct OidnFunctions {
    using Handle = void*;
    Handle (*oidnNewDevice)(int type);
    void (*oidnSetDeviceInt)(Handle device, const char* name, int value);
    int (*oidnGetDeviceInt)(Handle device, const char* name);
    void (*oidnCommitDevice)(Handle device);
    int (*oidnGetDeviceError)(Handle device, const char** message);
    void (*oidnReleaseDevice)(Handle device);
    Handle (*oidnNewFilter)(Handle device, const char* type);
    void (*oidnSetSharedFilterImage)(Handle filter, const char* name, void* pointer, int format,
                                     std::size_t width, std::size_t height, std::size_t byte_offset,
                                     std::size_t pixel_stride, std::size_t row_stride);
    void (*oidnSetFilterBool)(Handle filter, const char* name, bool value);
    void (*oidnCommitFilter)(Handle filter);
    void (*oidnExecuteFilter)(Handle filter);
    void (*oidnReleaseFilter)(Handle filter);

    static constexpr int device_type_cpu = 1;
    static constexpr int format_float3 = 3;
    static constexpr int no_error = 0;
};

/// Opens the library and resolves its functions; it stays open. Throws `Error` (unsupported) as
/// `Denoiser` does.
[[nodiscard]] OidnFunctions open_oidn(const std::optional<std::filesystem::path>& library);

}  // namespace bdpt::io
