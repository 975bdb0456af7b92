#pragma once

/// @file
/// Takes the noise out of an image.
///
/// @code{.cpp}
/// void write_denoised(const bdpt::RenderResult& result)
/// {
///     const bdpt::Image noisy = result.film.develop();
///     const bdpt::io::Denoiser denoiser;  // opens Open Image Denoise
///     bdpt::io::write_exr("clean.exr", denoiser.denoise({.image = noisy}), {});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace bdpt::io {

/// The input of a denoiser.
struct NoisyImage {
    const Image& image;             ///< radiance [nit], not clamped; any exposure
    const Layer* albedo = nullptr;  ///< of the same size, in [0, 1]
    const Layer* normal = nullptr;  ///< of the same size, in [-1, 1]; only beside albedo
};

/// Intel Open Image Denoise 2 [Afra 2019, openimagedenoise.org], from a library that is opened at
/// run time: nothing is linked, and programs that never denoise need none. Filters on the CPU.
class BDPT_EXPORT Denoiser {
public:
    /// Opens `library`, a file or a folder with libOpenImageDenoise.so.2, or without one what the
    /// system finds by that name; in a Python wheel first that of the package pyoidn beside it.
    /// `threads`: at most so many; 0: one for each processor. Throws `Error`: unsupported if there
    /// is no library, or it is not version 2; internal if it fails.
    explicit Denoiser(const std::optional<std::filesystem::path>& library = {}, int threads = 0);
    Denoiser(Denoiser&&) noexcept;
    Denoiser& operator=(Denoiser&&) noexcept;
    ~Denoiser();

    /// The version of the library: "2.5.1".
    [[nodiscard]] const std::string& version() const;
    /// `noisy` without noise, as high dynamic range. Albedo and normal are denoised first, as they
    /// are noisy where lenses or motion blur. The result depends on the library and on this
    /// machine. Throws `Error`: usage if sizes differ, internal (with the library's message) if it
    /// fails.
    [[nodiscard]] Image denoise(const NoisyImage& noisy) const;

private:
    struct Library;
    std::unique_ptr<const Library> library_;
};

}  // namespace bdpt::io
