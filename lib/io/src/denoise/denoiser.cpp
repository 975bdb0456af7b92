#include <bdpt/io/denoise.h>

#include <bdpt/error.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "file/read_file.h"

namespace bdpt::io {
namespace {

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
    void (*oidnSetFilterInt)(Handle filter, const char* name, int value);
    void (*oidnSetFilterProgressMonitorFunction)(Handle filter, bool (*goes_on)(void*, double),
                                                 void* argument);
    void (*oidnCommitFilter)(Handle filter);
    void (*oidnExecuteFilter)(Handle filter);
    void (*oidnReleaseFilter)(Handle filter);

    static constexpr int device_type_cpu = 1;
    static constexpr int format_float3 = 3;
    static constexpr int no_error = 0;
    static constexpr int quality_fast = 4;
    static constexpr int first_minor_with_quality_fast = 3;
};

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

/// Opens the library and resolves its functions; it stays open. Throws `Error` (unsupported) as
/// `Denoiser` does.
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
    find(module, file, "oidnSetFilterInt", functions.oidnSetFilterInt);
    find(module, file, "oidnSetFilterProgressMonitorFunction",
         functions.oidnSetFilterProgressMonitorFunction);
    find(module, file, "oidnCommitFilter", functions.oidnCommitFilter);
    find(module, file, "oidnExecuteFilter", functions.oidnExecuteFilter);
    find(module, file, "oidnReleaseFilter", functions.oidnReleaseFilter);
    return functions;
}

static_assert(sizeof(Rgb) == 3 * sizeof(float), "the library reads pixels as three floats");

using Handle = OidnFunctions::Handle;

/// A filter of the library, set up and run.
class Filter {
public:
    Filter(const OidnFunctions& oidn, Handle device, int width, int height)
        : oidn_(oidn),
          device_(device),
          filter_(oidn.oidnNewFilter(device, "RT")),
          width_(static_cast<std::size_t>(width)),
          height_(static_cast<std::size_t>(height))
    {}
    Filter(const Filter&) = delete;
    Filter& operator=(const Filter&) = delete;
    ~Filter() { oidn_.oidnReleaseFilter(filter_); }

    /// Sets an input. The library accesses it in place, and does not change inputs.
    void set(const char* name, const float* values)
    {
        oidn_.oidnSetSharedFilterImage(filter_, name, const_cast<float*>(values),
                                       OidnFunctions::format_float3, width_, height_, 0, 0, 0);
    }
    void set(const char* name, bool value) { oidn_.oidnSetFilterBool(filter_, name, value); }
    void set(const char* name, int value) { oidn_.oidnSetFilterInt(filter_, name, value); }

    void run(std::stop_token stop)
    {
        const auto goes_on = [](void* token, double /*progress*/) {
            return !static_cast<const std::stop_token*>(token)->stop_requested();
        };
        oidn_.oidnSetFilterProgressMonitorFunction(filter_, goes_on, &stop);
        oidn_.oidnCommitFilter(filter_);
        oidn_.oidnExecuteFilter(filter_);
        const char* message = nullptr;
        const int code = oidn_.oidnGetDeviceError(device_, &message);
        if (code != OidnFunctions::no_error && !stop.stop_requested()) {
            throw Error(ErrorCode::internal,
                        fmt::format("the denoiser failed: {}", message != nullptr ? message : ""));
        }
    }

private:
    const OidnFunctions& oidn_;
    Handle device_;
    Handle filter_;
    std::size_t width_;
    std::size_t height_;
};

void check_size(const Image& image, const Layer& layer)
{
    constexpr std::size_t channels = 3;
    if (layer.width != image.width || layer.height != image.height ||
        layer.channels.size() != channels) {
        throw Error(ErrorCode::usage,
                    fmt::format("the layer {} has {} x {} pixels of {} channels, but the image to "
                                "denoise has {} x {} of {}",
                                layer.name, layer.width, layer.height, layer.channels.size(),
                                image.width, image.height, channels));
    }
}

}  // namespace

struct Denoiser::Library {
    OidnFunctions oidn;
    Handle device;
    std::string version;
    bool has_quality_fast = false;

    Library(const std::optional<std::filesystem::path>& file, int threads)
        : oidn(open_oidn(file)), device(oidn.oidnNewDevice(OidnFunctions::device_type_cpu))
    {
        if (threads > 0) {
            oidn.oidnSetDeviceInt(device, "numThreads", threads);
        }
        // Otherwise the library would bind our threads to processors.
        oidn.oidnSetDeviceInt(device, "setAffinity", 0);
        oidn.oidnCommitDevice(device);
        const char* message = nullptr;
        if (device == nullptr ||
            oidn.oidnGetDeviceError(device, &message) != OidnFunctions::no_error) {
            throw Error(ErrorCode::internal, fmt::format("the denoiser cannot start: {}",
                                                         message != nullptr ? message : ""));
        }
        const int minor = oidn.oidnGetDeviceInt(device, "versionMinor");
        has_quality_fast = minor >= OidnFunctions::first_minor_with_quality_fast;
        version = fmt::format("{}.{}.{}", oidn.oidnGetDeviceInt(device, "versionMajor"), minor,
                              oidn.oidnGetDeviceInt(device, "versionPatch"));
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() { oidn.oidnReleaseDevice(device); }

    /// Denoises a layer, unless the image is for a preview.
    [[nodiscard]] std::vector<float> filtered(const char* name, const Layer& layer,
                                              const DenoiserControl& control) const
    {
        if (control.mode == DenoiserMode::preview) {
            return layer.values;
        }
        std::vector<float> output(layer.values.size());
        Filter filter(oidn, device, layer.width, layer.height);
        filter.set(name, layer.values.data());
        filter.set("output", output.data());
        if (has_quality_fast) {
            // As good for the image that they guide, in a third of the time.
            filter.set("quality", OidnFunctions::quality_fast);
        }
        filter.run(control.stop);
        return output;
    }
};

Denoiser::Denoiser(const std::optional<std::filesystem::path>& library, int threads)
    : library_(std::make_unique<const Library>(library, threads))
{}

Denoiser::Denoiser(Denoiser&&) noexcept = default;
Denoiser& Denoiser::operator=(Denoiser&&) noexcept = default;
Denoiser::~Denoiser() = default;

const std::string& Denoiser::version() const
{
    return library_->version;
}

Image Denoiser::denoise(const NoisyImage& noisy, const DenoiserControl& control) const
{
    const Image& image = noisy.image;
    Image result{image.width, image.height, std::vector<Rgb>(image.pixels.size(), Rgb(0.0f))};
    if (image.pixels.empty()) {
        return result;
    }
    std::vector<float> albedo;
    std::vector<float> normal;
    Filter filter(library_->oidn, library_->device, image.width, image.height);
    if (noisy.albedo != nullptr) {
        check_size(image, *noisy.albedo);
        albedo = library_->filtered("albedo", *noisy.albedo, control);
        filter.set("albedo", albedo.data());
        if (noisy.normal != nullptr) {
            check_size(image, *noisy.normal);
            normal = library_->filtered("normal", *noisy.normal, control);
            filter.set("normal", normal.data());
        }
        filter.set("cleanAux", control.mode == DenoiserMode::best);
    }
    if (control.mode == DenoiserMode::preview && library_->has_quality_fast) {
        filter.set("quality", OidnFunctions::quality_fast);
    }
    filter.set("color", &image.pixels.front().r);
    filter.set("output", &result.pixels.front().r);
    filter.set("hdr", true);
    filter.run(control.stop);
    return result;
}

}  // namespace bdpt::io
