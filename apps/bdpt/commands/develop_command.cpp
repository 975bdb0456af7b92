#include "commands/commands.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "options/output_files.h"
#include "options/render_arguments.h"
#include "output/image_files.h"
#include "output/values.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

/// Arguments of `bdpt develop`.
struct DevelopArguments {
    std::filesystem::path file{};  ///< .exr
    std::vector<std::filesystem::path> outputs{};
    DisplayArguments display{};
    DenoiseArguments denoise{};
    Printed printed{};
};

constexpr const char* develop_footer = R"(Examples:
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

/// Throws `OptionError` for incompatible options.
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

std::vector<fs::path> choose_outputs(const DevelopArguments& arguments)
{
    if (!arguments.outputs.empty()) {
        return arguments.outputs;
    }
    if (arguments.file == "-") {
        throw OptionError("--output is required for an image from the standard input");
    }
    return {default_output(arguments.file)};
}

/// Returns the display options of `image`: with the backdrop of its render, replaced by that of
/// `display` if given.
DisplayArguments choose_display(DisplayArguments display, const LayeredImage& image,
                                const fs::path& file)
{
    if (display.backdrop && !image.backdrop) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("--background \"{}\": {} contains the environment; render it with "
                                "--background, too",
                                backdrop_text(*display.backdrop), file.string()));
    }
    if (!display.backdrop) {
        display.backdrop = image.backdrop;
        if (display.backdrop && !display.backdrop->photo.empty()) {
            display.backdrop->photo = find_photo(display.backdrop->photo, file);
        }
    }
    check_metered(display.exposure, image.metadata, file.string());
    return display;
}

bool has_layer(const LayeredImage& image, const char* name)
{
    return std::any_of(image.layers.begin(), image.layers.end(),
                       [name](const Layer& layer) { return layer.name == name; });
}

int run_develop(const DevelopArguments& arguments, const OptionList& options,
                const Words& /*words*/)
{
    check(arguments, options);
    const std::vector<fs::path> outputs = choose_outputs(arguments);
    const std::string file = arguments.file.string();
    FileSet inputs({arguments.file});
    if (arguments.denoise.library) {
        inputs.add(*arguments.denoise.library);
    }
    check_outputs(outputs, inputs);
    TerminalConsole console(arguments.printed.format, arguments.printed.verbosity);
    const SignalInterrupt interrupt(pending_outputs(outputs), [] {});
    LayeredImage image = read_layered_image(
        arguments.file, arguments.denoise.kind == Denoising::none ? Wanted::main : Wanted::clean);
    for (const std::string& warning : image.warnings) {
        console.warning(fmt::format("{}: {}", file, warning));
    }
    const DisplayArguments display = choose_display(arguments.display, image, arguments.file);
    check_transparency(display, outputs);
    if (display.backdrop) {
        check_not_read(outputs, FileSet({display.backdrop->photo}));
    }
    check_backplate(display);
    DenoiseArguments denoise = arguments.denoise;
    if (image.is_denoised) {
        denoise.kind = Denoising::none;
    }
    if (denoise.is_asked() && !has_layer(image, "albedo")) {
        console.warning(
            fmt::format("{}: denoised without the layers albedo and normal, which keep "
                        "edges (--aov albedo,normal)",
                        file));
    }
    const std::optional<io::Denoiser> denoiser = open_denoiser(denoise, outputs, 0);
    ImageFileOptions how{
        .exr = {.metadata = std::move(image.metadata), .placement = image.placement},
        .layers = std::move(image.layers),
        .display = display,
        .denoiser = denoiser ? &*denoiser : nullptr,
        .denoising = denoise.kind};
    Attempts attempts;
    const WrittenImages written = write_image_files(outputs, image.image, std::move(how), attempts);
    if (!written.why_noisy.empty()) {
        console.warning(fmt::format("{}: not denoised: {}", file, written.why_noisy));
    }
    const bool are_denoised = image.is_denoised || !written.denoised.empty();
    for (const fs::path& output : written.files) {
        console.note(fmt::format("wrote {}, exposure {:.2f} EV{}", output.string(),
                                 written.exposure.value_or(0.0f),
                                 are_denoised ? ", denoised" : ""));
    }
    attempts.finish();
    console.event("done",
                  {{"outputs", names_json(written.files)},
                   {"denoised", names_json(are_denoised ? written.files : std::vector<fs::path>())},
                   {"exposure", or_null(written.exposure)}});
    return 0;
}

}  // namespace

void add_develop_command(Program& program)
{
    add_command<DevelopArguments>(program, "develop",
                                  "Convert an .exr file to pictures, without rendering",
                                  develop_footer, add_develop_options, run_develop);
}

}  // namespace bdpt::app
