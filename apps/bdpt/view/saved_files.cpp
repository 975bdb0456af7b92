#include "view/saved_files.h"

#include <fmt/core.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "report/image/denoised.h"
#include "report/image/image_files.h"
#include "report/render_report.h"
#include "terminal/temporary_folder.h"

namespace bdpt::app {
namespace {

io::ImageMetadata metadata(const LiveRender& render, const PreparedScene& stage)
{
    nlohmann::ordered_json settings = make_settings(render.arguments(), stage);
    io::ImageMetadata result = make_metadata(render.arguments(), stage, settings);
    result.samples_per_pixel = render.renderer().samples();
    result.render_seconds = render.renderer().seconds();
    result.created = std::chrono::system_clock::now();
    return result;
}

ImageFileOptions file_options(const LiveRender& render, const PreparedScene& stage,
                              const std::optional<io::Denoiser>& denoiser)
{
    const RenderArguments& arguments = render.arguments();
    const RenderResult& part = render.renderer().result();
    const PixelRect& region = part.film.region();
    return {.exr = {.type = arguments.exr.channel_type,
                    .metadata = metadata(render, stage),
                    .storage = arguments.exr.storage,
                    .placement = {{.x = region.x0,
                                   .y = region.y0,
                                   .full_width = stage.size.width,
                                   .full_height = stage.size.height}},
                    .manifests = part.ids.manifests()},
            .layers = develop_layers(part.film, part.aovs, part.ids),
            .display = arguments.display,
            .denoiser = denoiser ? &*denoiser : nullptr,
            .denoising = arguments.denoise.kind};
}

}  // namespace

Download saved_image(const LiveRender& render, const PreparedScene& stage,
                     std::string_view extension)
{
    const TemporaryFolder folder;
    const RenderArguments& arguments = render.arguments();
    const std::string name = fmt::format("{}{}", arguments.file.stem().string(), extension);
    const std::array files{folder.file(fmt::format("image{}", extension))};
    const std::optional<io::Denoiser> denoiser =
        open_denoiser(arguments.denoise, files, arguments.options.system.threads);
    Attempts attempts;
    static_cast<void>(write_image_files(files, render.renderer().image(),
                                        file_options(render, stage, denoiser), attempts));
    attempts.finish();
    std::ifstream file(files.front(), std::ios::binary);
    return {.type = extension == ".png" ? "image/png" : "image/x-exr",
            .name = name,
            .content = {std::istreambuf_iterator<char>(file), {}}};
}

float compute_exposure(const LiveRender& render, const PreparedScene& stage, const Image& image)
{
    return shown_exposure(render.arguments().display.exposure, metadata(render, stage), image);
}

}  // namespace bdpt::app
