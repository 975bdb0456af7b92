#include <bdpt/error.h>
#include <bdpt/io/part_file.h>
#include <bdpt/io/read_image.h>
#include <bdpt/io/write_image.h>
#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace bdpt::io {
namespace {

/// Returns the exponent of the rate `value`; one more than the greatest if it is invalid.
std::int8_t find_exponent(Rgb value)
{
    int exponent = SampleRates::min_exponent;
    while (exponent <= SampleRates::max_exponent && value != Rgb(SampleRates::to_rate(exponent))) {
        ++exponent;
    }
    return static_cast<std::int8_t>(exponent);
}

}  // namespace

void write_rates(const std::filesystem::path& file, const SampleRates& rates,
                 const ImageMetadata& metadata)
{
    Image image{rates.width(), rates.height(), {}};
    image.pixels.reserve(rates.exponents().size());
    for (const std::int8_t exponent : rates.exponents()) {
        image.pixels.emplace_back(SampleRates::to_rate(exponent));
    }
    ExrOptions options;
    options.type = ExrChannelType::half_float;
    options.metadata = metadata;
    write_exr(file, image, options);
}

SampleRates read_rates(const std::filesystem::path& file)
{
    const Image image = read_image(file).image;
    std::vector<std::int8_t> exponents;
    exponents.reserve(image.pixels.size());
    for (const Rgb& pixel : image.pixels) {
        exponents.push_back(find_exponent(pixel));
        if (exponents.back() > SampleRates::max_exponent) {
            const std::size_t i = exponents.size() - 1;
            const auto width = static_cast<std::size_t>(image.width);
            throw Error(
                ErrorCode::invalid_input,
                fmt::format("{}: pixel ({}, {}) is {}, {}, {}, but rates of samples are "
                            "the same power of two from 0.25 to 4 in R, G and B",
                            file.string(), i % width, i / width, pixel.r, pixel.g, pixel.b));
        }
    }
    return {image.width, image.height, std::move(exponents)};
}

}  // namespace bdpt::io
