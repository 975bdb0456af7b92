#include "options/groups/denoise_arguments.h"

#include <CLI/CLI.hpp>

#include "options/arguments.h"

namespace bdpt::app {

void add_denoise_options(CLI::App& command, DenoiseWords& words, const char* group)
{
    command
        .add_flag("--denoise", words.denoise,
                  "Denoise the image by Open Image Denoise 2, with the layers albedo and normal; "
                  ".exr keeps the noisy one as layer \"noisy\". As --denoise=layer the other way "
                  "round: .exr gets the layer \"denoised\"")
        ->group(group);
    command
        .add_option("--denoiser-library", words.library,
                    "Open Image Denoise 2, a file or its folder. Default: libOpenImageDenoise.so.2 "
                    "where the system finds it")
        ->type_name("FILE|DIR")
        ->group(group);
}

std::optional<DenoiseArguments> understand(const DenoiseWords& words)
{
    if (words.denoise.empty()) {
        if (words.library) {
            reject("--denoiser-library", *words.library, "--denoise with it");
        }
        return std::nullopt;
    }
    if (words.library && words.library->empty()) {
        reject("--denoiser-library", "", "a file or a folder");
    }
    const bool layer = words.denoise == "layer";
    if (!layer && words.denoise != "true" && words.denoise != "image") {
        reject("--denoise", words.denoise, "image or layer");
    }
    DenoiseArguments result{.as = layer ? DenoisedAs::layer : DenoisedAs::image};
    if (words.library) {
        result.library = *words.library;
    }
    return result;
}

}  // namespace bdpt::app
