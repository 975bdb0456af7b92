#include <bdpt/io/part_file.h>

#include <bdpt/error.h>
#include <bdpt/io/write_image.h>
#include <bdpt/render.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "scene_builder.h"
#include "scratch_folder.h"

namespace bdpt::io::rates_file_test {
namespace {

using test::ScratchFolder;

SampleRates all_rates(int width, int height)
{
    std::vector<std::int8_t> exponents;
    for (int i = 0; i < width * height; ++i) {
        exponents.push_back(static_cast<std::int8_t>(i % 5 - 2));
    }
    return {width, height, std::move(exponents)};
}

std::string refusal(const std::filesystem::path& file, ErrorCode code)
{
    try {
        static_cast<void>(read_rates(file));
    } catch (const Error& error) {
        CHECK(error.code() == code);
        return error.what();
    }
    return {};
}

void write_pixel(const std::filesystem::path& file, Rgb pixel)
{
    Image image{3, 2, std::vector<Rgb>(6, Rgb(1.0f))};
    image.pixels[4] = pixel;
    write_exr(file, image, ExrOptions{});
}

}  // namespace

TEST_CASE("rates are read as they were written", "[rates]")
{
    const ScratchFolder folder;
    const SampleRates rates = all_rates(13, 7);
    write_rates(folder / "rates.exr", rates, {});
    CHECK(read_rates(folder / "rates.exr") == rates);
}

TEST_CASE("files that hold no rates are refused by pixel and value", "[rates]")
{
    const ScratchFolder folder;
    const auto file = folder / "rates.exr";
    CHECK(refusal(file, ErrorCode::not_found).find(file.string()) == 0);
    for (const float wrong :
         {0.0f, 0.125f, 3.0f, 8.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(),
          std::numeric_limits<float>::infinity()}) {
        write_pixel(file, Rgb(wrong));
        CHECK(refusal(file, ErrorCode::invalid_input).find("pixel (1, 1) is ") !=
              std::string::npos);
    }
    write_pixel(file, {1.0f, 1.0f, 2.0f});
    CHECK(refusal(file, ErrorCode::invalid_input).find("is 1, 1, 2,") != std::string::npos);

    write_rates(file, all_rates(13, 7), {});
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    for (const std::size_t kept : {std::size_t{0}, std::size_t{100}, bytes.size() - 20}) {
        std::ofstream(file, std::ios::binary) << bytes.substr(0, kept);
        CHECK_FALSE(
            refusal(file, kept == 0 ? ErrorCode::unsupported : ErrorCode::invalid_input).empty());
    }
}

TEST_CASE("a part file holds how many samples pixels took", "[rates]")
{
    const ScratchFolder folder;
    test::SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.7f)), test::plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    const Scene scene(std::move(builder.desc));
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.film.width = 13;
    options.film.height = 7;
    options.film.crop = PixelRect{.x0 = 2, .y0 = 1, .x1 = 12, .y1 = 6};
    options.film.aovs = {Aov::sample_count, Aov::depth};
    options.transport.max_depth = 3;
    options.sampling.rates = std::make_shared<const SampleRates>(all_rates(13, 7));
    RenderResult sum;
    for (const std::int64_t begin : {0, 8}) {
        options.sampling.samples = {.begin = begin, .end = begin + 8};
        const RenderResult part = render(scene, test::room_camera(), options);
        const auto file = folder / ("part" + std::to_string(begin) + ".exr");
        CHECK(write_part(file, part, {}, OldPart::keep_if_more) == PartWrite::written);
        merge_part(sum, read_part_info(file));
    }
    options.sampling.samples = {.begin = 0, .end = 16};
    const RenderResult whole = render(scene, test::room_camera(), options);
    CHECK(sum.aovs == whole.aovs);
    CHECK(sum.film.develop().pixels == whole.film.develop().pixels);
    const std::vector<Layer> layers = sum.aovs.develop(sum.film);
    REQUIRE(layers.size() == 2);
    CHECK(layers[1].name == "sampleCount");
    CHECK(layers[1].values[0] == 16.0f * options.sampling.rates->rate(2, 1));
    CHECK(layers[1].values[11] == 16.0f * options.sampling.rates->rate(3, 2));
}

}  // namespace bdpt::io::rates_file_test
