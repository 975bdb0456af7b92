#include "options/groups/scene_arguments.h"

#include <string>
#include <string_view>

#include "options/arguments.h"
#include "options/values/value_types.h"

namespace bdpt::app {
namespace {

std::optional<io::Shutter> parse_shutter(std::string_view text)
{
    const std::size_t comma = text.find(',');
    const bool pair = comma != std::string_view::npos;
    const std::optional<double> open = pair ? parse_double(text.substr(0, comma)) : 0.0;
    const std::optional<double> close = parse_double(pair ? text.substr(comma + 1) : text);
    if (!open || !close || *close < *open) {
        return std::nullopt;
    }
    return io::Shutter{*open, *close};
}

}  // namespace

void add_scene_options(OptionList& options, io::GltfOptions& scene,
                       std::optional<std::uint64_t>& max_memory)
{
    options.add("--scene", "NAME|INDEX", "Scene of the file. Default: the file's default scene",
                scene.scene, any_text());
    options.add("--variant", "NAME|INDEX", "Material variant. Default: the materials of the meshes",
                scene.variant, any_text());
    options.add("--frame-time", "SECONDS",
                "Animation time to render [s]. Without this and --animation nothing is animated",
                scene.time, finite_number("a finite number of seconds"));
    options.add("--animation", "NAME|INDEX|all",
                "Animation for --frame-time, or all. Default: the first", scene.animation,
                any_text());
    options.add("--shutter", "SECONDS|OPEN,CLOSE",
                "Motion blur: seconds that the shutter is open after --frame-time, or OPEN,CLOSE "
                "relative to it",
                scene.shutter,
                parsed_by([](const std::string& text) { return parse_shutter(text); },
                          "seconds from 0, or OPEN,CLOSE with OPEN not after CLOSE"));
    Option& library =
        options.add("--ktx-library", "FILE|DIR",
                    "libktx 4 for KTX2 textures (KHR_texture_basisu): the library or its folder. "
                    "Default: the system's libktx.so.4",
                    scene.ktx_library, some_text("a file or a folder"));
    library.uses.stated_in = StatedIn::programs;  // it is code
    options
        .add_repeated(
            "--allow-folder", "DIR",
            "Folder outside of the scene's own that may have files of the scene, also behind "
            "symbolic links. Repeatable",
            scene.allowed_folders, file_path())
        .uses.stated_in = StatedIn::programs;  // it decides what the scene reads
    options.add_flag("--ignore-required",
                     "Render files that require unsupported extensions, or libktx where it is "
                     "missing, without these features",
                     scene.ignore_required);
    options.add_flag("--strict",
                     "Refuse files whose picture would lack something (missing textures, "
                     "extensions that are not supported, ...) or needs drafts of extensions, with "
                     "exit code 5, where a warning or a note is usual",
                     scene.strict);
    options.add("--max-memory", "SIZE",
                "Refuse scenes that need more memory than this, like 500M or 2G; a render includes "
                "its film and layers. Default: half of the machine's memory. Maximum: free memory, "
                "within the limits of the container and of ulimit -v",
                max_memory, memory_size());
}

}  // namespace bdpt::app
