#include <bdpt/light/environment_image.h>
#include <bdpt/memory/huge_pages.h>

#include "light/environment/environment_texels.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace bdpt {
namespace {

static_assert(sizeof(Rgb) == 3 * sizeof(float));

std::span<const float> values_of(std::span<const Rgb> row)
{
    return {&row[0].r, 3 * row.size()};
}

/// Encodes `values` / `scale`, which is a power of two, as halves; returns whether all are exact.
bool encode_exactly(std::span<const float> values, float scale, std::uint16_t* halves)
{
    constexpr std::uint32_t unit = 1U << 23U;  // of exponents in floats
    const std::uint32_t offset =
        std::bit_cast<std::uint32_t>(scale) - std::bit_cast<std::uint32_t>(1.0f) + 112U * unit;
    const float inverse = 1.0f / scale;
    bool exact = true;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto bits = std::bit_cast<std::uint32_t>(values[i]);
        const std::uint32_t moved = bits - offset;
        const bool is_normal = (moved & 0x1fffU) == 0 && moved - unit < 30U * unit;
        if (is_normal || bits == 0) [[likely]] {
            halves[i] = static_cast<std::uint16_t>(is_normal ? moved >> 13U : 0U);
        } else {
            halves[i] = to_half(values[i] * inverse);
            exact = exact && from_half(halves[i]) * scale == values[i];
        }
    }
    return exact;
}

std::optional<EnvironmentImage> compacted(const Image& image)
{
    const auto width = static_cast<std::size_t>(std::max(image.width, 0));
    const auto height = static_cast<std::size_t>(std::max(image.height, 0));
    if (image.pixels.empty() || image.pixels.size() != width * height) {
        return std::nullopt;
    }
    EnvironmentImageBuilder builder(image.width, image.height);
    const std::span pixels(image.pixels);
    for (std::size_t y = 0; y < height; ++y) {
        if (!builder.add_row(pixels.subspan(y * width, width))) {
            return std::nullopt;
        }
    }
    return builder.finish();
}

}  // namespace

EnvironmentImage::EnvironmentImage(Image image)
{
    if (std::optional<EnvironmentImage> compact = compacted(image)) {
        *this = *std::move(compact);
    } else {
        floats_ = std::make_shared<const Image>(std::move(image));
    }
}

EnvironmentImage::EnvironmentImage(EnvironmentTexels texels)
    : texels_(std::make_shared<const EnvironmentTexels>(std::move(texels)))
{}

int EnvironmentImage::width() const noexcept
{
    return texels_ ? texels_->width() : floats_ ? floats_->width : 0;
}

int EnvironmentImage::height() const noexcept
{
    return texels_ ? texels_->height() : floats_ ? floats_->height : 0;
}

Rgb EnvironmentImage::at(int x, int y) const
{
    return texels_ ? (*texels_)(x, y) : floats_->at(x, y);
}

void EnvironmentImage::copy_row(int y, std::span<Rgb> row) const
{
    for (std::size_t x = 0; x < row.size(); ++x) {
        row[x] = at(static_cast<int>(x), y);
    }
}

Image EnvironmentImage::to_image() const
{
    if (!texels_) {
        return floats_ ? *floats_ : Image{};
    }
    Image image{.width = width(), .height = height(), .pixels = {}};
    const auto row = static_cast<std::size_t>(image.width);
    image.pixels.resize(row * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y) {
        copy_row(y, std::span(image.pixels).subspan(static_cast<std::size_t>(y) * row, row));
    }
    return image;
}

EnvironmentImage EnvironmentImage::scaled(float factor) const
{
    const bool stays_valid = texels_ && factor >= 0.0f &&
                             texels_->greatest() * factor <= std::numeric_limits<float>::max();
    if (stays_valid) {
        EnvironmentTexels texels(*texels_, factor);
        if (texels.are_halves()) {
            return EnvironmentImage(std::move(texels));
        }
    }
    Image image = to_image();
    for (Rgb& pixel : image.pixels) {
        pixel *= factor;
    }
    EnvironmentImage result;
    result.floats_ = std::make_shared<const Image>(std::move(image));
    return result;
}

std::size_t EnvironmentImage::bytes() const noexcept
{
    return texels_ ? texels_->bytes() : floats_ ? floats_->pixels.size() * sizeof(Rgb) : 0;
}

EnvironmentImageBuilder::EnvironmentImageBuilder(int width, int height)
    : width_(width), height_(height)
{}

bool EnvironmentImageBuilder::add_row(std::span<const Rgb> row)
{
    const std::span<const float> values = values_of(row);
    float greatest = 0.0f;
    std::uint32_t invalid = 0;
    for (const float value : values) {
        invalid |= value >= 0.0f && value <= std::numeric_limits<float>::max() ? 0U : 1U;
        greatest = std::max(greatest, value);
    }
    if (invalid != 0) {
        return false;
    }
    reserve_in_huge_pages(halves_, values.size() * static_cast<std::size_t>(height_));
    const std::size_t begin = halves_.size();
    halves_.resize(begin + values.size());
    const float scale = scale_of_halves(greatest);
    row_scales_.push_back(scale);
    greatest_ = std::max(greatest_, greatest);
    return encode_exactly(values, scale, halves_.data() + begin);
}

std::optional<EnvironmentImage> EnvironmentImageBuilder::finish()
{
    const float scale = scale_of_halves(greatest_);
    std::vector<float> row(3 * static_cast<std::size_t>(width_));
    std::uint16_t* halves = halves_.data();
    for (const float row_scale : row_scales_) {
        if (row_scale != scale) {
            for (std::size_t i = 0; i < row.size(); ++i) {
                row[i] = from_half(halves[i]) * row_scale;
            }
            if (!encode_exactly(row, scale, halves)) {
                return std::nullopt;
            }
        }
        halves += row.size();
    }
    return EnvironmentImage(EnvironmentTexels(
        {.width = width_, .height = height_, .greatest = greatest_, .scale = scale},
        std::exchange(halves_, {})));
}

}  // namespace bdpt
