#include "options/develop_arguments.h"

#include <fmt/core.h>

#include <array>

#include "options/values/output_files.h"
#include "options/values/pipes.h"
#include "options/values/value_types.h"

namespace bdpt::app {

const char* const develop_footer = R"(Examples:
  bdpt develop room.exr
  bdpt develop room.exr -o bright.png --exposure 2 --tone-map agx
  bdpt develop chair.exr -o chair.jpg --background white
  bdpt develop room.exr -o clean.png --denoise

Pictures are those that bdpt render would have written with the same options. A background needs an
.exr that was rendered with --background, and --denoise is best with --aov albedo,normal.)";

void add_develop_options(OptionList& options, DevelopRequest& request)
{
    DevelopArguments& arguments = request.arguments;
    options
        .add("file", "FILE", "The image: .exr, with layers; - is the standard input",
             arguments.file, file_path({"-"}))
        .required = true;
    options.section("Output");
    options.add_repeated("-o,--output", "FILE",
                         "A picture, .png, .jpg or .webp; png:- and the like are the standard "
                         "output. May be repeated. Default: the name of the image with .png, in "
                         "the working directory",
                         arguments.outputs, file_path(standard_output_names()));
    add_display_options(options, arguments.display);
    add_denoise_options(options, request.denoise);
    add_quiet_option(options, arguments.printed);
    add_json_option(options, arguments.printed,
                    "Print one JSON object per line on stdout: warning, done, error");
}

DevelopArguments checked(const DevelopRequest& request, const OptionList& options)
{
    DevelopArguments result = request.arguments;
    result.denoise = checked(request.denoise, options);
    if (result.denoise && result.denoise->as == DenoisedAs::layer) {
        options.reject_value("--denoise", "no value: a picture has no layers");
    }
    for (const std::filesystem::path& output : result.outputs) {
        const std::optional<ImageType> type = find_type(output);
        if (type && !is_for_screens(*type)) {
            throw OptionError(
                fmt::format("{}: develop writes pictures for screens: name it .png, .jpg or .webp",
                            output.string()));
        }
    }
    check_pipes(std::array{result.file}, result.outputs, result.printed.format);
    return result;
}

}  // namespace bdpt::app
