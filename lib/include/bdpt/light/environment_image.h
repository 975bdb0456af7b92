#pragma once

/// @file
/// Holds the radiance of an environment compactly.
///
/// @code{.cpp}
/// bdpt::Image sky{.width = 2, .height = 1, .pixels = {bdpt::Rgb(1.0f), bdpt::Rgb(0.25f)}};
/// const bdpt::EnvironmentLightDesc light{.radiance = std::move(sky)};
/// const bdpt::Rgb radiance = light.radiance.at(1, 0);
/// std::cout << light.radiance.bytes() << " bytes, " << radiance.r << " nit\n";
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/types.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

class EnvironmentTexels;

/// An immutable image of radiance, whose copies and lights share its texels. They take 6 bytes each
/// if half floats times a power of two represent all of them exactly, as in files of half floats
/// and nearly all Radiance files, and otherwise those of floats.
class BDPT_EXPORT EnvironmentImage {
public:
    EnvironmentImage() = default;
    /// Takes over `image`. Not explicit: it has the same meaning. Values are not checked.
    EnvironmentImage(Image image);

    [[nodiscard]] int width() const noexcept;
    [[nodiscard]] int height() const noexcept;
    /// Returns a pixel; `x` in [0, width), `y` in [0, height).
    [[nodiscard]] Rgb at(int x, int y) const;
    /// Copies row `y` to `row`, which has `width` pixels.
    void copy_row(int y, std::span<Rgb> row) const;
    /// Returns the image as floats, which takes much memory for a large one.
    [[nodiscard]] Image to_image() const;
    /// Returns the image times `factor`. Compact texels stay compact: they are rounded by at most
    /// 1/2048, as for lookups.
    [[nodiscard]] EnvironmentImage scaled(float factor) const;
    /// Returns the memory of the texels [bytes].
    [[nodiscard]] std::size_t bytes() const noexcept;

    /// Returns the compact texels, for the library's own use; null if they are floats.
    [[nodiscard]] const std::shared_ptr<const EnvironmentTexels>& texels() const noexcept
    {
        return texels_;
    }
    /// Returns the image of floats; null if texels are compact, or there are none.
    [[nodiscard]] const Image* floats() const noexcept { return floats_.get(); }

private:
    friend class EnvironmentImageBuilder;
    explicit EnvironmentImage(EnvironmentTexels texels);

    std::shared_ptr<const EnvironmentTexels> texels_;
    std::shared_ptr<const Image> floats_;  // used instead of `texels_`
};

/// Makes a compact `EnvironmentImage` row by row, without an image of floats.
class BDPT_EXPORT EnvironmentImageBuilder {
public:
    /// For an image of this size, at least 1 x 1.
    EnvironmentImageBuilder(int width, int height);

    /// Adds the next row, from the top. Returns false if compact texels cannot represent it exactly
    /// or a value is negative or not finite: then the image has to be made from floats.
    [[nodiscard]] bool add_row(std::span<const Rgb> row);
    /// Returns the image of all rows, and leaves none; nullopt if the range from one row to another
    /// is too wide for compact texels.
    [[nodiscard]] std::optional<EnvironmentImage> finish();

private:
    int width_;
    int height_;
    float greatest_ = 0.0f;
    std::vector<float> row_scales_;  // powers of two
    std::vector<std::uint16_t> halves_;
};

}  // namespace bdpt
