#pragma once

#include <bdpt/image.h>
#include <bdpt/io/exr.h>
#include <bdpt/io/image_metadata.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>

#include <filesystem>
#include <vector>

#include "options/groups/strategy_arguments.h"
#include "options/render_arguments.h"
#include "options/values/file_set.h"

namespace bdpt::app {

/// Checks, before anything is rendered, that files can be written. Throws `Error`: usage if one is
/// an input or one of `outputs`, output for a place where nothing can be written.
void check_strategy_files(const StrategyFiles& files, const FileSet& inputs,
                          const FileSet& outputs);

/// Writes the image with the layers of all strategies, and the contact sheet. `exposure` [EV] is
/// that of the image. Throws `Error` (output).
void write_strategy_files(const StrategyFiles& files, const Image& image,
                          const StrategyFilm& strategies, const io::ExrOptions& options,
                          float exposure);

/// Writes rates as .exr, which --rates reads, or as .png in false colours: the number of samples of
/// each pixel. Throws `Error` (output).
void save_rates(const std::filesystem::path& file, const SampleRates& rates,
                const io::ImageMetadata& metadata);

/// Returns all files of images, strategy images included.
[[nodiscard]] std::vector<std::filesystem::path> all_image_files(const RenderArguments& arguments);

/// Throws `Error` if the job of `arguments`, whose author may be a stranger, names files to write:
/// invalid_input for those that are not in its folder or below, output for those that exist and
/// were not written by bdpt.
void check_files_of_job(const RenderArguments& arguments);

/// Checks, before anything is rendered, that files can be written, and returns all of them. Throws
/// `Error`: usage for files that are named twice, are among `inputs` or have a type that bdpt does
/// not write, output for places where nothing can be written.
[[nodiscard]] std::vector<std::filesystem::path> check_files(const RenderArguments& arguments,
                                                             const FileSet& inputs);

}  // namespace bdpt::app
