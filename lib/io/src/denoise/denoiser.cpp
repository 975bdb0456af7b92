#include "denoise/oidn_functions.h"

#include <bdpt/error.h>
#include <bdpt/io/denoise.h>

#include <fmt/format.h>

#include <cstddef>
#include <vector>

namespace bdpt::io {
namespace {

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

    void run()
    {
        oidn_.oidnCommitFilter(filter_);
        oidn_.oidnExecuteFilter(filter_);
        const char* message = nullptr;
        if (oidn_.oidnGetDeviceError(device_, &message) != OidnFunctions::no_error) {
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
        version = fmt::format("{}.{}.{}", oidn.oidnGetDeviceInt(device, "versionMajor"),
                              oidn.oidnGetDeviceInt(device, "versionMinor"),
                              oidn.oidnGetDeviceInt(device, "versionPatch"));
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() { oidn.oidnReleaseDevice(device); }

    /// Denoises a layer.
    [[nodiscard]] std::vector<float> filtered(const char* name, const Layer& layer) const
    {
        std::vector<float> output(layer.values.size());
        Filter filter(oidn, device, layer.width, layer.height);
        filter.set(name, layer.values.data());
        filter.set("output", output.data());
        filter.run();
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

Image Denoiser::denoise(const NoisyImage& noisy) const
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
        albedo = library_->filtered("albedo", *noisy.albedo);
        filter.set("albedo", albedo.data());
        if (noisy.normal != nullptr) {
            check_size(image, *noisy.normal);
            normal = library_->filtered("normal", *noisy.normal);
            filter.set("normal", normal.data());
        }
        filter.set("cleanAux", true);
    }
    filter.set("color", &image.pixels.front().r);
    filter.set("output", &result.pixels.front().r);
    filter.set("hdr", true);
    filter.run();
    return result;
}

}  // namespace bdpt::io
