#pragma once

#include <bdpt/io/volume.h>
#include <bdpt/medium_desc.h>

#include <filesystem>

#include "options/option_list.h"

namespace bdpt::app {

/// A volume of an OpenVDB file to put into the scene.
struct VolumeChoice {
    std::filesystem::path file{};
    io::VolumeOptions options{};  ///< without limits
};

/// Adds --fog, --fog-albedo and --fog-anisotropy.
void add_fog_options(OptionList& options, MediumDesc& fog);

/// Adds --volume and the options whose names begin with it.
void add_volume_options(OptionList& options, VolumeChoice& volume);

/// Throws `OptionError` if one of them is given without --fog or --volume.
void check_medium_options(const OptionList& options);

}  // namespace bdpt::app
