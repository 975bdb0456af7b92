#include "options/groups/medium_arguments.h"

#include <array>

#include "options/values/value_types.h"

namespace bdpt::app {

void add_fog_options(OptionList& options, MediumDesc& fog)
{
    options.add("--fog", "X|R,G,B",
                "Fill the scene, but for its bodies, with a medium that scatters and absorbs: its "
                "extinction, which is one over the mean free path [1/m]",
                fog.extinction, extinction());
    options.add("--fog-albedo", "X|R,G,B",
                "Single-scattering albedo of the fog, from 0 to 1. Default: 1", fog.albedo,
                albedo());
    options.add("--fog-anisotropy", "G",
                "Anisotropy of the phase function of the fog, between -1 and 1: > 0 scatters "
                "forwards, as mist does. Default: 0, isotropic",
                fog.anisotropy, anisotropy());
}

void add_volume_options(OptionList& options, VolumeChoice& volume)
{
    options
        .add("--volume", "FILE.vdb",
             "Put smoke or a cloud into the scene: an OpenVDB file, whose transform is taken as "
             "metres",
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
                "The grid of the volume that has its densities. Default: density, or the only one "
                "of floats",
                volume.options.grid, some_text("the name of a grid"));
    options.add("--volume-extinction", "X|R,G,B",
                "Extinction of the volume where its density is 1 [1/m]. Default: 1",
                volume.options.extinction, extinction());
    options.add("--volume-albedo", "X|R,G,B",
                "Single-scattering albedo of the volume, from 0 to 1. Default: 1",
                volume.options.albedo, albedo());
    options.add("--volume-anisotropy", "G",
                "Anisotropy of the phase function of the volume, between -1 and 1: > 0 scatters "
                "forwards, as clouds do. Default: 0, isotropic",
                volume.options.anisotropy, anisotropy());
    const Choices<io::UpAxis> axes{{{"y", io::UpAxis::y}, {"z", io::UpAxis::z}}};
    options.add("--volume-up", "y|z",
                "The axis of the file that points up: y (default) or z, as in Blender",
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
