#include "options/groups/scene_arguments.h"

#include <array>
#include <string>
#include <string_view>

#include "options/value_types.h"

namespace bdpt::job {

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
    options.add(
        "--shutter", "SECONDS|OPEN,CLOSE",
        "Motion blur: seconds that the shutter is open after --frame-time, or OPEN,CLOSE "
        "relative to it",
        scene.shutter,
        parsed_by(parse_shutter, "seconds from 0, or OPEN,CLOSE with OPEN not after CLOSE"));
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

void add_environment_options(OptionList& options, EnvironmentChange& change)
{
    options.add("--env-rotation", "DEG",
                "Rotate the environment about the vertical axis, counter-clockwise seen from "
                "above: 90 moves -z to -x [degrees]",
                change.rotation, number(-360.0, 360.0, "degrees from -360 to 360"));
    options.add("--env-intensity", "X", "Multiply the radiance of the environment by this",
                change.intensity, number(0.0, 1e6, "a factor from 0 to 1000000"));
}

void add_fog_options(OptionList& options, MediumDesc& fog)
{
    options.add("--fog", "X|R,G,B",
                "Fill the scene, except inside its bodies, with a homogeneous participating medium "
                "of this extinction, 1 / mean free path [1/m]",
                fog.extinction, extinction());
    options.add("--fog-albedo", "X|R,G,B",
                "Single-scattering albedo of the fog, from 0 to 1. Default: 1", fog.albedo,
                albedo());
    options.add("--fog-anisotropy", "G",
                "Anisotropy of the fog's phase function, between -1 and 1: > 0 scatters forward, "
                "like mist. Default: 0, isotropic",
                fog.anisotropy, anisotropy());
}

void add_volume_options(OptionList& options, VolumeChoice& volume)
{
    options
        .add("--volume", "FILE.vdb",
             "Add smoke or a cloud from an OpenVDB file, whose transform is in metres", volume.file,
             ValueType<std::string>{.parse =
                                        [](const std::string& text) {
                                            return text.empty() || text == "-"
                                                       ? std::nullopt
                                                       : std::optional(text);
                                        },
                                    .expected = "a file",
                                    .info = {.is_path = true}})
        .uses.plan_render = false;  // plans store files separately
    options.add("--volume-grid", "NAME",
                "Density grid of the volume. Default: density, or the only float grid",
                volume.options.grid, some_text("the name of a grid"));
    options.add("--volume-extinction", "X|R,G,B",
                "Extinction of the volume where its density is 1 [1/m]. Default: 1",
                volume.options.extinction, extinction());
    options.add("--volume-albedo", "X|R,G,B",
                "Single-scattering albedo of the volume, from 0 to 1. Default: 1",
                volume.options.albedo, albedo());
    options.add("--volume-anisotropy", "G",
                "Anisotropy of the volume's phase function, between -1 and 1: > 0 scatters "
                "forward, like clouds. Default: 0, isotropic",
                volume.options.anisotropy, anisotropy());
    const Choices<io::UpAxis> axes{{{"y", io::UpAxis::y}, {"z", io::UpAxis::z}}};
    options.add("--volume-up", "y|z", "Up axis of the file: y (default) or z, as in Blender",
                volume.options.up, axes.type());
}

void check_medium_options(const OptionList& options)
{
    static constexpr std::array needs{
        Need{"--fog-albedo", "--fog"},       Need{"--fog-anisotropy", "--fog"},
        Need{"--volume-grid", "--volume"},   Need{"--volume-extinction", "--volume"},
        Need{"--volume-albedo", "--volume"}, Need{"--volume-anisotropy", "--volume"},
        Need{"--volume-up", "--volume"},
    };
    check(needs, options);
}

}  // namespace bdpt::job
