// Denoising by a library that is opened at run time; here one that counts
// (tests/support/fake_oidn.cpp).

#include <bdpt/error.h>
#include <bdpt/io/denoise.h>

#include <fstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "scratch_folder.h"

namespace bdpt::test::denoising_test {
namespace {

Layer layer(const char* name, float value, int width = 2)
{
    return {.name = name,
            .channels = "RGB",
            .width = width,
            .height = 1,
            .values = std::vector<float>(static_cast<std::size_t>(3 * width), value)};
}

const Image noisy{2, 1, {Rgb(1.0f, 2.0f, 3.0f), Rgb(40.0f, 50.0f, 60.0f)}};

Error refusal(const std::filesystem::path& library)
{
    try {
        const io::Denoiser denoiser(library);
    } catch (const Error& error) {
        return error;
    }
    return Error(ErrorCode::internal, "accepted");
}

}  // namespace

TEST_CASE("an image is denoised with layers that were denoised before")
{
    const io::Denoiser denoiser(BDPT_FAKE_OIDN);
    CHECK(denoiser.version() == "2.71.8");
    const Layer albedo = layer("albedo", 0.25f);
    const Layer normal = layer("normal", 0.5f);
    const Image alone = denoiser.denoise({.image = noisy});
    CHECK(alone.pixels[1] == Rgb(80.0f, 100.0f, 120.0f));
    const Image with_albedo = denoiser.denoise({.image = noisy, .albedo = &albedo});
    CHECK(with_albedo.pixels[0] == Rgb(3.25f, 5.25f, 7.25f));
    const Image with_both =
        denoiser.denoise({.image = noisy, .albedo = &albedo, .normal = &normal});
    CHECK(with_both.pixels[0] == Rgb(5.75f, 7.75f, 9.75f));
    CHECK(albedo.values[0] == 0.25f);
}

TEST_CASE("a preview is denoised with layers as they are, and can be stopped")
{
    const io::Denoiser denoiser(BDPT_FAKE_OIDN);
    const Layer albedo = layer("albedo", 0.25f);
    const Layer normal = layer("normal", 0.5f);
    std::stop_source source;
    const auto denoised = [&] {
        return denoiser.denoise({.image = noisy, .albedo = &albedo, .normal = &normal},
                                {io::DenoiserMode::preview, source.get_token()});
    };
    CHECK(denoised().pixels[0] == Rgb(2.75f, 4.75f, 6.75f));
    source.request_stop();
    CHECK(denoised().pixels[0] == Rgb(0.0f));  // and no error
}

TEST_CASE("an image without pixels is denoised to itself")
{
    const Image image = io::Denoiser(BDPT_FAKE_OIDN).denoise({.image = Image{}});
    CHECK(image.pixels.empty());
}

TEST_CASE("layers of another size are refused by the denoiser")
{
    const io::Denoiser denoiser(BDPT_FAKE_OIDN);
    const Layer albedo = layer("albedo", 0.25f, 3);
    REQUIRE_THROWS_WITH(denoiser.denoise({.image = noisy, .albedo = &albedo}),
                        ContainsSubstring("albedo") && ContainsSubstring("3 x 1"));
}

TEST_CASE("a denoiser is found in a folder")
{
    const ScratchFolder folder;
    std::filesystem::create_symlink(BDPT_FAKE_OIDN, folder / "libOpenImageDenoise.so.2");
    CHECK(io::Denoiser(folder / ".").version() == "2.71.8");
}

TEST_CASE("what is no denoiser is refused by name")
{
    const ScratchFolder folder;
    std::ofstream(folder / "text.so") << "no library";
    for (const char* name : {"absent.so", "text.so"}) {
        const Error error = refusal(folder / name);
        CHECK(error.code() == ErrorCode::unsupported);
        CHECK(std::string(error.what()).find(name) != std::string::npos);
        CHECK(std::string(error.what()).find("openimagedenoise.org") != std::string::npos);
    }
    const Error error = refusal(BDPT_FAKE_KTX);
    CHECK(error.code() == ErrorCode::unsupported);
    CHECK(std::string(error.what()).find("oidnNewDevice") != std::string::npos);
}

}  // namespace bdpt::test::denoising_test
