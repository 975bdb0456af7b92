// Evenness: prints the steps of noise that rates of samples make in renders by any version of bdpt.

#include <bdpt/eval/evenness.h>
#include <bdpt/io/read_image.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace bdpt;

std::vector<std::filesystem::path> images_in(const std::string& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Reads the first three values of each pixel of a layer; ids are single channels.
Layer read_layer(const std::filesystem::path& file, const std::string& name)
{
    const auto read = [&](const std::string& part) {
        return io::read_image(file, {.layer = part}).image;
    };
    const bool is_id = name.starts_with("Crypto");
    const Image first = read(is_id ? name + ".r" : name);
    const Image fractions = is_id ? read(name + ".g") : Image{};
    Layer layer{.name = name,
                .channels = "RGB",
                .width = first.width,
                .height = first.height,
                .values = {}};
    for (std::size_t i = 0; i < first.pixels.size(); ++i) {
        const Rgb value = first.pixels[i];
        const Rgb pixel = is_id ? Rgb(value.r, fractions.pixels[i].r, 0.0f) : value;
        layer.values.insert(layer.values.end(), {pixel.r, pixel.g, pixel.b});
    }
    return layer;
}

}  // namespace

int main(int argc, char** argv)
{
    std::string rated;
    std::string even;
    CLI::App app{"How much does the noise of neighbouring blocks on one surface differ by rates?"};
    app.add_option("rated", rated, "Folder of EXR images with rates, one for each seed")
        ->required();
    app.add_option("even", even, "Folder of images by the same seeds with --adaptive=false")
        ->required();
    CLI11_PARSE(app, argc, argv);
    try {
        std::array<std::vector<Image>, 2> images;
        std::vector<Layer> layers;
        for (std::size_t i = 0; i < images.size(); ++i) {
            for (const std::filesystem::path& file : images_in(i == 0 ? rated : even)) {
                images[i].push_back(io::read_image(file).image);
                if (layers.empty()) {
                    for (const char* name : {"albedo", "normal", "CryptoObject00"}) {
                        layers.push_back(read_layer(file, name));
                    }
                }
            }
        }
        const auto steps = eval::noise_steps(images[0], images[1], layers);
        const auto above = std::count_if(steps.begin(), steps.end(),
                                         [](const auto& step) { return step.least() > 1.3; });
        std::printf("%zu pairs of blocks; %lld surely differ by more than 1.3 times the noise\n",
                    steps.size(), static_cast<long long>(above));
        for (std::size_t i = 0; i < std::min<std::size_t>(steps.size(), 5); ++i) {
            const eval::NoiseStep& step = steps[i];
            std::printf("  %d,%d to %d,%d: %.2f, at least %.2f\n", step.first.x0, step.first.y0,
                        step.second.x0, step.second.y0, step.ratio, step.least());
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
}
