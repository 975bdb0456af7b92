#include "options/groups/volume_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "options/arguments.h"
#include "options/values/medium_values.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

void reject_without_volume(const VolumeWords& words)
{
    const auto check = [](const char* option, const auto& word) {
        if (word) {
            reject(option, fmt::format("{}", *word), "--volume with it");
        }
    };
    check("--volume-grid", words.grid);
    check("--volume-extinction", words.extinction);
    check("--volume-albedo", words.albedo);
    check("--volume-anisotropy", words.anisotropy);
    check("--volume-up", words.up);
}

}  // namespace

void add_volume_options(CLI::App& command, VolumeWords& words, const char* group)
{
    command
        .add_option("--volume", words.file,
                    "Put smoke or a cloud into the scene: an OpenVDB file, whose transform is "
                    "taken as metres")
        ->type_name("FILE.vdb")
        ->group(group);
    command
        .add_option("--volume-grid", words.grid,
                    "The grid of the volume that has its densities. Default: density, or the only "
                    "one of floats")
        ->type_name("NAME")
        ->group(group);
    command
        .add_option("--volume-extinction", words.extinction,
                    "Extinction of the volume where its density is 1 [1/m]. Default: 1")
        ->type_name("X|R,G,B")
        ->group(group);
    command
        .add_option("--volume-albedo", words.albedo,
                    "How much of what the volume takes away it scatters, from 0 to 1. Default: 1")
        ->type_name("X|R,G,B")
        ->group(group);
    command
        .add_option("--volume-anisotropy", words.anisotropy,
                    "Where the volume scatters to, between -1 and 1: > 0 forwards, as clouds do. "
                    "Default: 0, everywhere alike")
        ->type_name("G")
        ->group(group);
    command
        .add_option("--volume-up", words.up,
                    "The axis of the file that points up: y (default) or z, as in Blender")
        ->check(one_of({"y", "z"}))
        ->type_name("y|z")
        ->group(group);
}

std::optional<VolumeChoice> understand(const VolumeWords& words)
{
    if (!words.file) {
        reject_without_volume(words);
        return std::nullopt;
    }
    if (words.file->empty() || *words.file == "-") {
        reject("--volume", *words.file, "a file");
    }
    if (words.grid && words.grid->empty()) {
        reject("--volume-grid", *words.grid, "the name of a grid");
    }
    VolumeChoice choice{.file = *words.file};
    choice.options.grid = words.grid;
    if (words.extinction) {
        choice.options.extinction =
            color_of("--volume-extinction", *words.extinction, most_extinction,
                     "a number per metre from 0 to 1000000, or three");
    }
    if (words.albedo) {
        choice.options.albedo = albedo_of("--volume-albedo", *words.albedo);
    }
    if (words.anisotropy) {
        choice.options.anisotropy = anisotropy_of("--volume-anisotropy", *words.anisotropy);
    }
    choice.options.up = words.up == "z" ? io::UpAxis::z : io::UpAxis::y;
    return choice;
}

}  // namespace bdpt::app
