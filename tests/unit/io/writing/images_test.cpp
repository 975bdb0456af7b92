#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <bdpt/io/write_image.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <string_view>

#include "catch.hpp"
#include "image_files.h"
#include "scratch_folder.h"

namespace bdpt::io::writing_images_test {
namespace {

using test::ScratchFolder;

Image ramp(int width, int height)
{
    Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
        const auto t = static_cast<float>(i);
        image.pixels.push_back({0.1f * t, 1.0f / (1.0f + t), 1e-3f * t * t});
    }
    return image;
}

ImageMetadata metadata()
{
    ImageMetadata result;
    result.version = "1.2.3";
    result.scene = "models/caf\xc3\xa9.glb";
    result.settings = R"({"max_depth":8})";
    result.integrator = "mis";
    result.seed = 18446744073709551615u;
    result.samples_per_pixel = 37;
    result.render_seconds = 1.5;
    result.created = std::chrono::system_clock::time_point(std::chrono::seconds(86400 * 366));
    return result;
}

bool same_bits(const Image& a, const Image& b)
{
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

TEST_CASE("an EXR file of floats holds the pixels to the bit")
{
    const ScratchFolder folder;
    Image image = ramp(13, 7);
    image.pixels[5] = Rgb(1e30f, 1e-38f, 70000.0f);
    const ExrReport report =
        write_exr(folder / "a.exr", image, {ExrChannelType::single_float, metadata()});
    const test::ExrFile file = test::read_exr(folder / "a.exr");
    CHECK(report.clamped_pixels == 0);
    CHECK(file.image.width == 13);
    CHECK(file.image.height == 7);
    CHECK(same_bits(file.image, image));
    CHECK(file.header.compression() == Imf::ZIP_COMPRESSION);
    CHECK(file.header.channels().findChannel("R")->type == Imf::FLOAT);
    CHECK(folder.names() == std::set<std::string>{"a.exr"});
}

TEST_CASE("images whose pixels do not fit their size are refused")
{
    const ScratchFolder folder;
    const auto [width, height, pixels] = GENERATE(
        table<int, int, int>({{0, 0, 0}, {2, 2, 0}, {2, 2, 3}, {2, 2, 5}, {-2, -2, 4}, {0, 3, 0}}));
    CAPTURE(width, height, pixels);
    const auto count = static_cast<std::size_t>(pixels);
    const auto refuses = [](const auto& write) {
        try {
            write();
        } catch (const Error& error) {
            return error.code() == ErrorCode::usage;
        }
        return false;
    };
    const Image image{width, height, std::vector<Rgb>(count)};
    DisplayImage display{width, height, std::vector<std::uint8_t>(3 * count)};
    CHECK(refuses([&] { write_exr(folder / "a.exr", image, {}); }));
    CHECK(refuses([&] { write_exr(folder / "a.exr", image, {ExrChannelType::half_float, {}}); }));
    CHECK(refuses([&] { write_png(folder / "a.png", display, {}); }));
    display = {1, 1, std::vector<std::uint8_t>(4)};
    CHECK(refuses([&] { write_png(folder / "a.png", display, {}); }));
    CHECK(folder.names().empty());
}

TEST_CASE("an EXR file of halves clamps what they cannot hold, and counts it")
{
    const ScratchFolder folder;
    Image image = ramp(4, 2);
    image.pixels[1] = Rgb(65504.0f, 65519.0f, 1.0f);
    image.pixels[2] = Rgb(1e30f, std::numeric_limits<float>::infinity(), 2.0f);
    const ExrReport report =
        write_exr(folder / "a.exr", image, {ExrChannelType::half_float, metadata()});
    const test::ExrFile file = test::read_exr(folder / "a.exr");
    CHECK(report.clamped_pixels == 2);
    CHECK(file.header.channels().findChannel("G")->type == Imf::HALF);
    CHECK(file.image.pixels[1] == Rgb(65504.0f, 65504.0f, 1.0f));
    CHECK(file.image.pixels[2] == Rgb(65504.0f, 65504.0f, 2.0f));
    CHECK(file.image.pixels[7].r == Approx(0.7f).epsilon(1e-3));
}

TEST_CASE("an EXR file says how it was made")
{
    const ScratchFolder folder;
    write_exr(folder / "a.exr", ramp(4, 2), {ExrChannelType::single_float, metadata()});
    const test::ExrFile file = test::read_exr(folder / "a.exr");
    const Imf::Header& header = file.header;
    CHECK(file.text("software") == "bdpt 1.2.3");
    CHECK(file.text("bdpt.version") == "1.2.3");
    CHECK(file.text("bdpt.scene") == "models/caf\xc3\xa9.glb");
    CHECK(file.text("bdpt.settings") == R"({"max_depth":8})");
    CHECK(file.text("bdpt.integrator") == "mis");
    CHECK(file.text("bdpt.seed") == "18446744073709551615");
    CHECK(file.integer("bdpt.spp") == 37);
    CHECK(file.integer("samplesPerPixel") == 37);
    CHECK(file.number("bdpt.renderTimeSeconds") == 1.5f);
    CHECK(file.number("renderTimeSeconds") == 1.5f);
    CHECK(Imf::capDate(header) == "1971:01:02 00:00:00");
    CHECK(Imf::utcOffset(header) == 0.0f);
    CHECK(Imf::whiteLuminance(header) == 1.0f);
    CHECK(Imf::chromaticities(header).red == Imath::V2f(0.64f, 0.33f));
    CHECK(Imf::chromaticities(header).white == Imath::V2f(0.3127f, 0.3290f));
}

TEST_CASE("the matrices in an EXR file put points where the camera sees them")
{
    // At (1, 2, 3), looking along +x, +y up; enlarged, which a camera ignores.
    ImageMetadata data = metadata();
    data.camera.world_from_camera =
        Mat4(Vec4(0.0f, 0.0f, 2.0f, 0.0f), Vec4(0.0f, 2.0f, 0.0f, 0.0f),
             Vec4(-2.0f, 0.0f, 0.0f, 0.0f), Vec4(1.0f, 2.0f, 3.0f, 1.0f));
    data.camera.vertical_fov = 2.0f * std::atan(0.5f);
    const ScratchFolder folder;
    write_exr(folder / "a.exr", ramp(40, 20), {ExrChannelType::single_float, data});
    const Imf::Header header = test::read_exr(folder / "a.exr").header;

    // 10 m ahead, 4 m to the right (+z), 2 m up.
    const Imath::V3f point(11.0f, 4.0f, 7.0f);
    Imath::V3f camera;
    Imf::worldToCamera(header).multVecMatrix(point, camera);
    CHECK(camera.x == Approx(4.0f));
    CHECK(camera.y == Approx(2.0f));
    CHECK(camera.z == Approx(10.0f));

    // The image is 20 m wide and 10 m high there.
    Imath::V3f ndc;
    Imf::worldToNDC(header).multVecMatrix(point, ndc);
    CHECK(ndc.x == Approx(0.5f + 4.0f / 20.0f));
    CHECK(ndc.y == Approx(0.5f - 2.0f / 10.0f));

    // Of a film half as wide that is moved by half its width and a tenth of its height.
    data.camera.pixel_aspect = 0.5f;
    data.camera.shift = {0.5f, 0.1f};
    write_exr(folder / "a.exr", ramp(40, 20), {ExrChannelType::single_float, data});
    const Imf::Header shifted = test::read_exr(folder / "a.exr").header;
    CHECK(shifted.pixelAspectRatio() == 0.5f);
    Imf::worldToNDC(shifted).multVecMatrix(point, ndc);
    CHECK(ndc.x == Approx(0.5f - 0.5f + 4.0f / 10.0f));
    CHECK(ndc.y == Approx(0.5f + 0.1f - 2.0f / 10.0f));
}

TEST_CASE("the matrices of an orthographic camera do not make far things small")
{
    ImageMetadata data = metadata();
    data.camera.world_from_camera = Mat4(1.0f);
    data.camera.projection = Projection::orthographic;
    data.camera.vertical_extent = 8.0f;
    const ScratchFolder folder;
    write_exr(folder / "a.exr", ramp(40, 20), {ExrChannelType::single_float, data});
    const Imf::Header header = test::read_exr(folder / "a.exr").header;
    // The image is 16 m wide and 8 m high at all depths.
    for (const float depth : {1.0f, 100.0f}) {
        Imath::V3f ndc;
        Imf::worldToNDC(header).multVecMatrix(Imath::V3f(4.0f, 2.0f, -depth), ndc);
        CHECK(ndc.x == Approx(0.5f + 4.0f / 16.0f));
        CHECK(ndc.y == Approx(0.5f - 2.0f / 8.0f));
    }
}

TEST_CASE("a PNG file holds the pixels and says how it was made")
{
    const ScratchFolder folder;
    const DisplayImage image = tone_map(ramp(9, 5), 0.5f);
    write_png(folder / "a.png", image, {.exposure = 0.5f, .metadata = metadata()});
    test::PngFile file = test::read_png(folder / "a.png");
    CHECK(file.width == 9);
    CHECK(file.height == 5);
    CHECK(file.rgb == image.rgb);
    CHECK(file.has_srgb_chunk);
    CHECK(file.text["Software"] == "bdpt 1.2.3");
    CHECK(file.text["Creation Time"] == "1971-01-02T00:00:00Z");
    CHECK(file.text["bdpt.scene"] == "models/caf\xc3\xa9.glb");
    CHECK(file.text["bdpt.settings"] == R"({"max_depth":8})");
    CHECK(file.text["bdpt.spp"] == "37");
    CHECK(file.text["bdpt.exposure"] == "0.5");
    CHECK(folder.names() == std::set<std::string>{"a.png"});
}

TEST_CASE("images that cannot be written are output errors and leave nothing")
{
    const ScratchFolder folder;
    const Image image = ramp(4, 4);
    const auto code_of = [](auto&& write) {
        try {
            write();
        } catch (const Error& error) {
            CHECK(std::string(error.what()).find("cannot write") != std::string::npos);
            return error.code();
        }
        return ErrorCode::internal;
    };
    CHECK(code_of([&] { write_exr(folder / "no/a.exr", image, {}); }) == ErrorCode::output);
    CHECK(code_of([&] { write_png(folder / "no/a.png", tone_map(image, 0.0f), {}); }) ==
          ErrorCode::output);
    CHECK(folder.names().empty());
}

/// While it lives, no file of this process grows beyond `bytes`: like a disk that is full.
class SmallDisk {
public:
    explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
        ::getrlimit(RLIMIT_FSIZE, &previous_);
        const rlimit small{bytes, previous_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SmallDisk()
    {
        ::setrlimit(RLIMIT_FSIZE, &previous_);
        std::signal(SIGXFSZ, handler_);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

private:
    void (*handler_)(int);
    rlimit previous_{};
};

TEST_CASE("an output file with a failed write cannot be committed")
{
    const ScratchFolder folder;
    const SmallDisk disk(4);
    OutputFile file(folder / "a.exr");
    CHECK_THROWS_AS(file.write(std::string_view("more than four")), Error);
    // OpenEXR swallows errors while it closes a file.
    CHECK_THROWS_AS(file.commit(), Error);
    CHECK(folder.names().count("a.exr") == 0);
}

TEST_CASE("a disk that fills up in the middle leaves no half image")
{
    const ScratchFolder folder;
    // Pixels that do not compress, so that the files reach the limits.
    Image image{64, 64, {}};
    std::uint32_t state = 1;
    for (int i = 0; i < 64 * 64; ++i) {
        state = state * 1664525u + 1013904223u;
        image.pixels.push_back(Rgb(static_cast<float>(state), 1.0f, static_cast<float>(i)));
    }
    test::write_text(folder / "a.exr", "the old one");
    std::set<ErrorCode> codes;
    // In the header; in the pixels; and just before the end.
    write_exr(folder / "whole.exr", image, {});
    const auto whole = std::filesystem::file_size(folder / "whole.exr");
    for (const rlim_t limit : {rlim_t{100}, rlim_t{whole / 2}, rlim_t{whole - 1}}) {
        const SmallDisk disk(limit);
        try {
            write_exr(folder / "a.exr", image, {});
            codes.insert(ErrorCode::internal);
        } catch (const Error& error) {
            codes.insert(error.code());
        }
    }
    CHECK(codes == std::set{ErrorCode::output});
    CHECK(test::read_text(folder / "a.exr") == "the old one");
    CHECK(folder.names() == std::set<std::string>{"a.exr", "whole.exr"});

    const SmallDisk disk(500);
    CHECK_THROWS_AS(write_png(folder / "a.png", tone_map(image, -30.0f), {}), Error);
    CHECK(folder.names() == std::set<std::string>{"a.exr", "whole.exr"});
}

}  // namespace
}  // namespace bdpt::io::writing_images_test
