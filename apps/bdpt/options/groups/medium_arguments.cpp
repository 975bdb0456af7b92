#include "options/groups/medium_arguments.h"

#include <array>

#include "options/values/value_types.h"

namespace bdpt::app {

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
             "Add smoke or a cloud from an OpenVDB file, whose transform is in metres",
             volume.file,
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
    options.add("--volume-up", "y|z",
                "Up axis of the file: y (default) or z, as in Blender",
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

}  // namespace bdpt::app
