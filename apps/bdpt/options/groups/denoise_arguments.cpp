#include "options/groups/denoise_arguments.h"

#include <array>

#include "options/values/value_types.h"

namespace bdpt::app {

void add_denoise_options(OptionList& options, DenoiseArguments& denoise)
{
    const Choices<DenoisedAs> kinds{{{"image", DenoisedAs::image},
                                     {"layer", DenoisedAs::layer},
                                     {"true", DenoisedAs::image}}};  // without a value
    Option& flag = options.add_flag(
        "--denoise",
        "Denoise the image with Open Image Denoise 2, guided by albedo and normal; .exr keeps the "
        "noisy image as layer \"noisy\". With --denoise=layer .exr stays noisy and gets the layer "
        "\"denoised\"",
        denoise.as,
        ValueType<DenoisedAs>{
            .parse = kinds.type().parse, .expected = "image or layer", .info = kinds.type().info});
    flag.uses.plan_render = true;  // its layers are needed for merging
    Option& library =
        options.add("--denoiser-library", "FILE|DIR",
                    "Open Image Denoise 2: the library or its folder. Default: the system's "
                    "libOpenImageDenoise.so.2; in a Python environment, that of pyoidn",
                    denoise.library, some_text("a file or a folder"));
    library.uses = {.python_save = true, .stated_in = StatedIn::programs};  // it is code
}

std::optional<DenoiseArguments> checked(const DenoiseArguments& denoise, const OptionList& options)
{
    static constexpr std::array needs{Need{"--denoiser-library", "--denoise"}};
    check(needs, options);
    return options.given("--denoise") ? std::optional(denoise) : std::nullopt;
}

}  // namespace bdpt::app
