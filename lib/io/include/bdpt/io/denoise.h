#pragma once

/// @file
/// Takes the noise out of an image.
///
/// @code{.cpp}
/// void write_denoised(const bdpt::RenderResult& result)
/// {
///     const bdpt::Image noisy = result.image();
///     const bdpt::io::Denoiser denoiser;  // opens Open Image Denoise
///     bdpt::io::write_exr("clean.exr", denoiser.denoise({.image = noisy}), {});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

namespace bdpt::io {

/// Input of a denoiser.
struct NoisyImage {
    const Image& image;             ///< radiance [nit], not clamped; any exposure
    const Layer* albedo = nullptr;  ///< albedo layer of the same size, in [0, 1]
    const Layer* normal = nullptr;  ///< normals of the same size, in [-1, 1]; require albedo
};

/// How much time a denoised image is worth.
enum class DenoiserMode : std::uint8_t {
    best,
    preview,  ///< an eighth of the time: a smaller filter, and albedo and normal as they are
};

/// Control of a denoiser that works.
struct DenoiserControl {
    DenoiserMode mode = DenoiserMode::best;
    /// A request ends it within a step of its filter; the image is then invalid.
    std::stop_token stop{};
};

/// Intel Open Image Denoise 2 [Afra 2019, openimagedenoise.org], from a library that is opened at
/// run time: it is not linked, and programs that never denoise do not need it. Filters on the CPU.
class BDPT_EXPORT Denoiser {
public:
    /// Opens `library`: a file, or a folder with libOpenImageDenoise.so.2; by default the one that
    /// BDPT_DENOISER in the environment names (none if that is empty), else denoiser/lib/ beside
    /// bdpt::io or in its folder bdpt/, in a Python wheel the package pyoidn beside it, else the
    /// library that the system finds by that name. `threads`: maximum number of threads; 0: one per
    /// processor. Throws `Error`: unsupported if there is no library, or it is not version 2;
    /// internal if it fails.
    explicit Denoiser(const std::optional<std::filesystem::path>& library = {}, int threads = 0);
    Denoiser(Denoiser&&) noexcept;
    Denoiser& operator=(Denoiser&&) noexcept;
    ~Denoiser();

    /// Returns the version of the library: "2.5.1".
    [[nodiscard]] const std::string& version() const;
    /// Denoises `noisy` as high dynamic range. Albedo and normal are denoised first, as lenses and
    /// motion blur make them noisy. The result depends on the library and on this machine. Throws
    /// `Error`: usage if sizes differ, internal (with the library's message) if it fails.
    [[nodiscard]] Image denoise(const NoisyImage& noisy, const DenoiserControl& control = {}) const;

private:
    struct Library;
    std::unique_ptr<const Library> library_;
};

}  // namespace bdpt::io
