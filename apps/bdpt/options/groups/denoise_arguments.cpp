#include "options/groups/denoise_arguments.h"

#include <algorithm>

#include "options/values/output_files.h"
#include "options/values/value_types.h"

namespace bdpt::app {

void add_denoise_options(OptionList& options, DenoiseArguments& denoise)
{
    const Choices<Denoising> kinds{{{"auto", Denoising::automatic},
                                    {"image", Denoising::image},
                                    {"layer", Denoising::layer},
                                    {"true", Denoising::image},  // without a value
                                    {"false", Denoising::none}}};
    Option& flag = options.add_flag(
        "--denoise",
        "Denoise the image with Open Image Denoise 2, guided by albedo and normal; .exr keeps the "
        "noisy image as layer \"noisy\". With --denoise=layer .exr stays noisy and gets the layer "
        "\"denoised\". Default: auto, which denoises .png, .jpg and .webp if the library is found, "
        "and never .exr and .hdr; --denoise=false denoises nothing",
        denoise.kind,
        ValueType<Denoising>{.parse = kinds.type().parse,
                             .expected = "auto, image, layer, true or false",
                             .info = kinds.type().info});
    flag.uses.plan_render = true;  // its layers are needed for merging
    flag.default_is_chosen = true;
    Option& library =
        options.add("--denoiser-library", "FILE|DIR",
                    "Open Image Denoise 2: the library or its folder. Default: BDPT_DENOISER in "
                    "the environment, else the library that comes with bdpt, else the system's "
                    "libOpenImageDenoise.so.2",
                    denoise.library, some_text("a file or a folder"));
    library.uses = {.python_save = true, .stated_in = StatedIn::programs};  // it is code
}

bool needs_denoiser(const DenoiseArguments& asked, std::span<const std::filesystem::path> outputs)
{
    return asked.kind == Denoising::automatic
               ? std::any_of(outputs.begin(), outputs.end(), is_for_screens)
               : asked.is_asked() && !outputs.empty();
}

std::vector<Aov> missing_guides(const AovSet& known, const std::optional<Backdrop>& backdrop)
{
    std::vector<Aov> guides{Aov::albedo, Aov::normal};
    if (backdrop) {
        guides.push_back(Aov::opacity);
    }
    std::erase_if(guides, [&known](Aov aov) { return known.contains(aov); });
    return guides;
}

}  // namespace bdpt::app
