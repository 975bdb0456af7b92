// Measures texture lookups per second and memory: of plain textures, with huge pages, of mipmaps,
// and by OpenImageIO's texture system from a file.

#include "texture/mip_maps.h"
#include "texture/texture.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/texture.h>
#include <sys/mman.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace bdpt;

struct Settings {
    std::vector<int> sizes{1024, 4096, 8192};
    int pixels = 1024;        // side of the image
    int lookups = 1'000'000;  // per run
    int rounds = 3;
    int cache_mb = 256;  // cache of the texture system
};

/// Returns stripes of several widths with noise: fine and coarse detail.
TexelImage pattern(int size)
{
    TexelImage image{.width = size, .height = size, .bytes = {}, .channels = 3};
    const std::size_t bytes = 3 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    image.bytes.reserve(bytes);
    std::minstd_rand random(7);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const auto noise = static_cast<unsigned>(random()) >> 8U;
            const unsigned coarse = ((x * 16 / size + y * 16 / size) % 2 == 0) ? 60 : 120;
            for (unsigned c = 0; c < 3; ++c) {
                image.bytes.push_back(static_cast<std::uint8_t>(coarse + (noise >> (5 * c)) % 128));
            }
        }
    }
    return image;
}

/// Copies the image to the operating system's huge pages, as far as available.
TexelImage with_huge_pages(const TexelImage& image)
{
    TexelImage copy{.width = image.width,
                    .height = image.height,
                    .bytes = {},
                    .channels = image.channels,
                    .type = image.type};
    copy.bytes.reserve(image.bytes.size());
    constexpr std::size_t page = std::size_t{2} << 20U;
    void* begin = copy.bytes.data();
    std::size_t space = copy.bytes.capacity();
    if (std::align(page, page, begin, space) != nullptr) {
        madvise(begin, space / page * page, MADV_HUGEPAGE);
    }
    copy.bytes.assign(image.bytes.begin(), image.bytes.end());
    return copy;
}

/// Returns the places of lookups: along the rows of the image, as of first hits on the wall by rays
/// of neighbouring pixels; or anywhere, as after a bounce and from light.
std::vector<Vec2> places(const Settings& settings, bool anywhere)
{
    std::vector<Vec2> result;
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform;
    const auto side = static_cast<float>(settings.pixels);
    for (int i = 0; i < settings.lookups; ++i) {
        if (anywhere) {
            result.emplace_back(uniform(random), uniform(random));
            continue;
        }
        const int pixel = i / 4;  // four samples per pixel
        const Vec2 corner(pixel % settings.pixels, pixel / settings.pixels % settings.pixels);
        result.push_back((corner + Vec2(uniform(random), uniform(random))) / side);
    }
    return result;
}

/// Returns millions of lookups per second of CPU time: the best of the rounds.
double rate(const Settings& settings, const std::vector<Vec2>& where,
            const std::function<float(Vec2)>& look)
{
    double best = 0.0;
    volatile float sink = 0.0f;
    for (int round = 0; round < settings.rounds; ++round) {
        const std::clock_t start = std::clock();
        float sum = 0.0f;
        for (const Vec2 uv : where) {
            sum += look(uv);
        }
        sink = sink + sum;
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        best = std::max(best, static_cast<double>(where.size()) / seconds / 1e6);
    }
    static_cast<void>(sink);
    return best;
}

void report(const char* name, const Settings& settings, double megabytes,
            const std::function<float(Vec2)>& look)
{
    std::printf("  %-34s %8.2f %8.2f M/s %9.0f MB\n", name,
                rate(settings, places(settings, false), look),
                rate(settings, places(settings, true), look), megabytes);
    std::fflush(stdout);
}

double count_megabytes(std::span<const TexelImage> images)
{
    double bytes = 0.0;
    for (const TexelImage& image : images) {
        bytes += static_cast<double>(image.bytes.size());
    }
    return bytes / 1e6;
}

float compute_sum(Vec4 value)
{
    return value.x + value.y + value.z;
}

void measure_own(const TexelImage& image, const Settings& settings)
{
    const auto none = Vec2(0.0f);
    const Texture plain({}, image, Encoding::srgb);
    const double megabytes = count_megabytes(std::span(&image, 1));
    report("bilinear", settings, megabytes,
           [&](Vec2 uv) { return compute_sum(plain.lookup({uv, none})); });

    const TexelImage huge_image = with_huge_pages(image);
    const Texture huge({}, huge_image, Encoding::srgb);
    report("bilinear, huge pages", settings, megabytes,
           [&](Vec2 uv) { return compute_sum(huge.lookup({uv, none})); });

    MipMaps maps([](int count, const auto& work) { work(0, count); });
    const auto coarser = maps.of(0, image, Encoding::srgb);
    const Texture mipped({}, image, Encoding::srgb, coarser);
    UvFootprint pixel;
    const float step = 1.0f / static_cast<float>(settings.pixels);
    pixel[0] = {.along = Vec2(step, 0.0f), .across = Vec2(0.0f, step)};
    report("mip-mapped", settings, megabytes + count_megabytes(coarser),
           [&](Vec2 uv) { return compute_sum(mipped.lookup({uv, none}, &pixel)); });
}

void measure_texture_system(const TexelImage& image, const Settings& settings,
                            const std::string& file)
{
    OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
    const OIIO::ImageBuf buffer(spec, const_cast<std::uint8_t*>(image.bytes.data()));
    OIIO::ImageSpec wish;
    wish.attribute("maketx:filtername", "box");
    if (!OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, buffer, file, wish)) {
        std::fprintf(stderr, "%s\n", OIIO::geterror().c_str());
        return;
    }
    OIIO::TextureSystem* system = OIIO::TextureSystem::create(false);
    system->attribute("max_memory_MB", static_cast<float>(settings.cache_mb));
    auto* handle = system->get_texture_handle(OIIO::ustring(file));
    auto* thread = system->get_perthread_info();
    for (const bool mip : {false, true}) {
        OIIO::TextureOpt options;
        options.swrap = OIIO::TextureOpt::WrapPeriodic;
        options.twrap = OIIO::TextureOpt::WrapPeriodic;
        options.interpmode = OIIO::TextureOpt::InterpBilinear;
        options.mipmode = mip ? OIIO::TextureOpt::MipModeOneLevel : OIIO::TextureOpt::MipModeNoMIP;
        const float step = mip ? 1.0f / static_cast<float>(settings.pixels) : 0.0f;
        report(mip ? "OpenImageIO, mip-mapped" : "OpenImageIO, bilinear", settings,
               settings.cache_mb, [&](Vec2 uv) {
                   float texel[3];
                   system->texture(handle, thread, options, uv.x, uv.y, step, 0.0f, 0.0f, step, 3,
                                   texel);
                   return texel[0] + texel[1] + texel[2];
               });
    }
    OIIO::TextureSystem::destroy(system);
    std::filesystem::remove(file);
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    std::string folder = std::filesystem::temp_directory_path().string();
    CLI::App app{"Lookups of textures a second, in neighbouring pixels and anywhere"};
    app.add_option("--sizes", settings.sizes, "Texels a side")->capture_default_str();
    app.add_option("--pixels", settings.pixels, "Pixels a side of what shows the texture")
        ->capture_default_str();
    app.add_option("--lookups", settings.lookups, "Of each run")->capture_default_str();
    app.add_option("--rounds", settings.rounds, "Runs of which the best counts")
        ->capture_default_str();
    app.add_option("--cache", settings.cache_mb, "Memory of the texture system [MB]")
        ->capture_default_str();
    app.add_option("--folder", folder, "For the texture system's file")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    for (const int size : settings.sizes) {
        std::printf("%d x %d, sRGB, 8 bits       pixels   anywhere\n", size, size);
        const TexelImage image = pattern(size);
        measure_own(image, settings);
        measure_texture_system(image, settings, folder + "/bdpt_texture_lookup.tx");
    }
    return 0;
}
