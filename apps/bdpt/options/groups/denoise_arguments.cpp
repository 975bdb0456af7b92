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
        "Denoise the image by Open Image Denoise 2, with the layers albedo and "
        "normal; .exr keeps the noisy one as layer \"noisy\". As --denoise=layer the "
        "other way round: .exr gets the layer \"denoised\"",
        denoise.as,
        ValueType<DenoisedAs>{
            .parse = kinds.type().parse, .expected = "image or layer", .info = kinds.type().info});
    flag.uses.plan_render = true;  // its layers are needed for merging
    Option& library =
        options.add("--denoiser-library", "FILE|DIR",
                    "Open Image Denoise 2, a file or its folder. Default: libOpenImageDenoise.so.2 "
                    "where the system finds it, in a Python environment that of pyoidn",
                    denoise.library, some_text("a file or a folder"));
    // No file may choose code to load.
    library.uses = {.python_save = true, .job = false, .program = true};
}

std::optional<DenoiseArguments> checked(const DenoiseArguments& denoise, const OptionList& options)
{
    static constexpr std::array needs{Need{"--denoiser-library", "--denoise"}};
    check(needs, options);
    return options.given("--denoise") ? std::optional(denoise) : std::nullopt;
}

}  // namespace bdpt::app
