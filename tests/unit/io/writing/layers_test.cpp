#include <OpenEXR/ImfTileDescription.h>
#include <bdpt/error.h>
#include <bdpt/io/write_image.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scratch_folder.h"

namespace bdpt::io::layers_test {
namespace {

using test::ScratchFolder;

constexpr float infinity = std::numeric_limits<float>::infinity();

Image ramp(int width, int height)
{
    Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
        const auto t = static_cast<float>(i);
        image.pixels.push_back({0.1f * t, 1.0f / (1.0f + t), 1e-3f * t * t});
    }
    return image;
}

/// A layer whose values count up from `first`.
Layer counting(const std::string& name, const std::string& channels, const Image& image,
               float first)
{
    Layer layer{.name = name,
                .channels = channels,
                .width = image.width,
                .height = image.height,
                .values = {}};
    for (std::size_t i = 0; i < image.pixels.size() * channels.size(); ++i) {
        layer.values.push_back(first + static_cast<float>(i));
    }
    return layer;
}

std::vector<float> every(const Layer& layer, std::size_t channel)
{
    std::vector<float> values;
    for (std::size_t i = channel; i < layer.values.size(); i += layer.channels.size()) {
        values.push_back(layer.values[i]);
    }
    return values;
}

std::set<std::string> channel_names(const Imf::Header& header)
{
    std::set<std::string> names;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        names.insert(c.name());
    }
    return names;
}

TEST_CASE("an EXR file holds layers by their names, to the bit")
{
    const ScratchFolder folder;
    const Image image = ramp(70, 5);
    std::vector<Layer> layers{counting("", "A", image, 0.25f),
                              counting("normal", "XYZ", image, -300.5f),
                              counting("depth", "Z", image, 1e6f + 0.5f)};
    layers[2].values[3] = infinity;
    const auto type = GENERATE(ExrChannelType::single_float, ExrChannelType::half_float);
    const auto storage = GENERATE(ExrStorage::scanlines, ExrStorage::tiles);
    write_exr(folder / "a.exr", image, layers, {.type = type, .metadata = {}, .storage = storage});
    const test::ExrFile file = test::read_exr(folder / "a.exr");
    CHECK(channel_names(file.header) ==
          std::set<std::string>{"A", "B", "G", "R", "depth.Z", "normal.X", "normal.Y", "normal.Z"});
    CHECK(file.header.hasTileDescription() == (storage == ExrStorage::tiles));
    // Beauty may be stored in halves; positions and depths would suffer.
    const auto main_type = type == ExrChannelType::half_float ? Imf::HALF : Imf::FLOAT;
    CHECK(file.header.channels().findChannel("R")->type == main_type);
    CHECK(file.header.channels().findChannel("A")->type == main_type);
    CHECK(file.header.channels().findChannel("depth.Z")->type == Imf::FLOAT);
    const auto channel = [&](const char* name) {
        return test::read_exr_channel(folder / "a.exr", name);
    };
    CHECK(channel("normal.X") == every(layers[1], 0));
    CHECK(channel("normal.Y") == every(layers[1], 1));
    CHECK(channel("normal.Z") == every(layers[1], 2));
    CHECK(channel("depth.Z") == every(layers[2], 0));
    CHECK(channel("A") == every(layers[0], 0));  // quarters below 2^9 fit into halves
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float margin = type == ExrChannelType::half_float ? 1e-3f : 0.0f;
        REQUIRE(std::abs(file.image.pixels[i].g - image.pixels[i].g) <= margin);
    }
}

TEST_CASE("a tiled EXR file has the pixels of one of scanlines")
{
    const ScratchFolder folder;
    const Image image = ramp(150, 67);  // of several tiles, the last ones smaller
    write_exr(folder / "lines.exr", image, {});
    write_exr(folder / "tiles.exr", image,
              {.metadata = {}, .storage = ExrStorage::tiles, .placement = {}});
    const test::ExrFile tiles = test::read_exr(folder / "tiles.exr");
    CHECK(tiles.header.tileDescription().xSize == 64);
    CHECK(tiles.header.tileDescription().mode == Imf::ONE_LEVEL);
    CHECK_FALSE(test::read_exr(folder / "lines.exr").header.hasTileDescription());
    CHECK(tiles.image.pixels == image.pixels);
    CHECK(test::read_exr(folder / "lines.exr").image.pixels == image.pixels);
}

TEST_CASE("a crop is placed in its image")
{
    const ScratchFolder folder;
    const Image image = ramp(6, 4);
    const auto storage = GENERATE(ExrStorage::scanlines, ExrStorage::tiles);
    ImageMetadata metadata;
    metadata.camera.vertical_fov = 2.0f * std::atan(0.5f);
    write_exr(folder / "a.exr", image,
              {.metadata = metadata,
               .storage = storage,
               .placement = ExrPlacement{.x = 30, .y = 7, .full_width = 40, .full_height = 20}});
    const test::ExrFile file = test::read_exr(folder / "a.exr");
    CHECK(file.header.dataWindow() == Imath::Box2i({30, 7}, {35, 10}));
    CHECK(file.header.displayWindow() == Imath::Box2i({0, 0}, {39, 19}));
    CHECK(file.image.pixels == image.pixels);
    // 10 m ahead the whole image is 20 m wide and 10 m high.
    Imath::V3f ndc;
    Imf::worldToNDC(file.header).multVecMatrix(Imath::V3f(5.0f, 0.0f, -10.0f), ndc);
    CHECK(ndc.x == Approx(0.75f));
}

TEST_CASE("layers that do not fit are refused and nothing is written")
{
    const ScratchFolder folder;
    const Image image = ramp(4, 2);
    const auto refuses = [&](const std::vector<Layer>& layers, const std::string& expected) {
        try {
            write_exr(folder / "a.exr", image, layers, {});
            FAIL("accepted");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::usage);
            CHECK(std::string(error.what()).find(expected) != std::string::npos);
        }
        CHECK(folder.names().empty());
    };
    refuses({counting("depth", "Z", ramp(2, 4), 0.0f)}, "layer \"depth\" has 2x4 pixels");
    Layer few = counting("depth", "Z", image, 0.0f);
    few.values.pop_back();
    refuses({few}, "7 values");
    refuses({counting("depth", "Z", image, 0.0f), counting("depth", "Z", image, 0.0f)},
            "two layers have a channel \"depth.Z\"");
    refuses({counting("", "R", image, 0.0f)}, "\"R\"");
}

}  // namespace
}  // namespace bdpt::io::layers_test
