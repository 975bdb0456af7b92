#include "report/strategy_files.h"

#include <bdpt/error.h>
#include <bdpt/eval/image/contact_sheet.h>
#include <bdpt/io/output_file.h>
#include <bdpt/io/png.h>
#include <fmt/core.h>

#include "options/values/output_files.h"

namespace bdpt::app {

namespace fs = std::filesystem;

void check_strategy_files(const StrategyFiles& files, const FileSet& inputs, const FileSet& outputs)
{
    for (const fs::path& file : files.both()) {
        if (inputs.contains(file) || outputs.contains(file)) {
            throw Error(
                ErrorCode::usage,
                fmt::format(
                    "--strategies \"{}\": {} is an input or another output", files.layers.string(),
                    file == files.layers ? "it" : "the sheet " + file.string() + " beside it"));
        }
        io::check_writable(file);
    }
}

void write_strategy_files(const StrategyFiles& files, const Image& image,
                          const StrategyFilm& strategies, const io::ExrOptions& options,
                          float exposure)
{
    io::write_exr(files.layers, image, strategies.develop(), options);
    io::write_png(files.sheet, eval::contact_sheet(strategies, exposure),
                  {.exposure = exposure, .metadata = options.metadata});
}

}  // namespace bdpt::app
