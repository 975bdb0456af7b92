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

Writes the pictures that bdpt render would write with the same options. --background needs an .exr
that was rendered with --background; --denoise works best with --aov albedo,normal.)";

void add_develop_options(OptionList& options, DevelopArguments& arguments)
{
    options
        .add("file", "FILE", "The image: .exr, with layers; - is the standard input",
             arguments.file, file_path({"-"}))
        .required = true;
    options.section("Output");
    options.add_repeated("-o,--output", "FILE",
                         "A picture, .png, .jpg or .webp; png:- etc. write to standard output. May "
                         "be repeated. Default: the image's name with .png, in the working "
                         "directory",
                         arguments.outputs, file_path(standard_output_names()));
    add_display_options(options, arguments.display);
    add_denoise_options(options, arguments.denoise);
    add_quiet_option(options, arguments.printed);
    add_json_option(options, arguments.printed,
                    "Print one JSON object per line on stdout: warning, done, error");
}

void check(const DevelopArguments& arguments, const OptionList& options)
{
    if (arguments.denoise.kind == Denoising::layer) {
        options.reject_value("--denoise", "no value: a picture has no layers");
    }
    for (const std::filesystem::path& output : arguments.outputs) {
        if (find_type(output) && !is_for_screens(output)) {
            throw OptionError(fmt::format(
                "{}: develop writes display images: name it .png, .jpg or .webp", output.string()));
        }
    }
    check_pipes(std::array{arguments.file}, arguments.outputs, arguments.printed.format);
}

}  // namespace bdpt::app
