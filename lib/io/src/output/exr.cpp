#include <bdpt/io/write_image.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfFramesPerSecond.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/chrono.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <limits>
#include <list>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "output/exr_output.h"
#include "output/image_output.h"

namespace bdpt::io {

namespace {

/// Returns {"lamp":"4090f8a4",...}
std::string manifest_text(const IdManifest& manifest)
{
    using Json = nlohmann::json;
    Json names = Json::object();
    for (const NamedId& name : manifest.names) {
        names[name.name] = hex_text(name.id);
    }
    return names.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void add_cryptomatte_metadata(Imf::Header& header, std::span<const IdManifest> manifests)
{
    for (const IdManifest& manifest : manifests) {
        if (header.channels().findChannel(manifest.layer + "00.r") == nullptr) {
            continue;
        }
        constexpr std::size_t key_length = 7;
        const std::string key =
            "cryptomatte/" + hex_text(name_id(manifest.layer)).substr(0, key_length) + "/";
        const auto insert = [&](const char* name, const std::string& text) {
            header.insert(key + name, Imf::StringAttribute(text));
        };
        insert("name", manifest.layer);
        insert("hash", "MurmurHash3_32");
        insert("conversion", "uint32_to_float32");
        insert("manifest", manifest_text(manifest));
    }
}

namespace {

/// GLM has v' = M v in columns, Imath v' = v M in rows: the same numbers in the same places.
Imath::M44f to_imath(const Mat4& matrix)
{
    Imath::M44f result;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            result[i][j] = matrix[i][j];
        }
    }
    return result;
}

}  // namespace

void add_exr_metadata(Imf::Header& header, const ImageMetadata& metadata, float aspect)
{
    const float seconds = static_cast<float>(metadata.render_seconds);
    const int samples = static_cast<int>(
        std::min<std::int64_t>(metadata.samples_per_pixel, std::numeric_limits<int>::max()));

    header.pixelAspectRatio() = metadata.camera.pixel_aspect;
    Imf::addChromaticities(header, Imf::Chromaticities{});  // default is Rec. 709
    Imf::addWhiteLuminance(header, 1.0f);                   // pixels are in nit
    const std::time_t created = std::chrono::system_clock::to_time_t(metadata.created);
    Imf::addCapDate(header, fmt::format("{:%Y:%m:%d %H:%M:%S}", fmt::gmtime(created)));
    Imf::addUtcOffset(header, 0.0f);
    Imf::addWorldToCamera(header, to_imath(camera_from_file(metadata.camera, metadata.origin)));
    Imf::addWorldToNDC(header, to_imath(ndc_from_file(metadata.camera, metadata.origin, aspect)));

    header.insert("software", Imf::StringAttribute(software_name(metadata)));
    for (const auto& [name, text] : text_entries(metadata)) {
        header.insert(name.c_str(), Imf::StringAttribute(text));
    }
    if (metadata.frame) {
        // Standard attributes: an image's number in the order of play, and its rate.
        header.insert("imageCounter", Imf::IntAttribute(metadata.frame->number));
        if (metadata.frame->per_second > 0.0) {
            Imf::addFramesPerSecond(header, Imf::guessExactFps(metadata.frame->per_second));
        }
    }
    header.insert("bdpt.spp", Imf::IntAttribute(samples));
    header.insert("bdpt.renderTimeSeconds", Imf::FloatAttribute(seconds));
    header.insert("samplesPerPixel", Imf::IntAttribute(samples));
    header.insert("renderTimeSeconds", Imf::FloatAttribute(seconds));
}

namespace {

constexpr float max_half = 65504.0f;

/// Returns the crop in the whole image; Imath's boxes include their upper corner.
Imath::Box2i data_window(int width, int height, const ExrPlacement& placement)
{
    return {{placement.x, placement.y}, {placement.x + width - 1, placement.y + height - 1}};
}

/// One channel of a file: the layout of its values in memory.
struct Channel {
    std::string name;
    Imf::PixelType type;
    const void* first;
    std::size_t pixel_stride;  // [bytes]
};

/// The channels to write, and the halves that some of them point to.
class Content {
public:
    explicit Content(Imf::PixelType main_type) : main_type_(main_type) {}

    /// Adds a channel for each of `names`, which are letters. Refers to `values`: one float per
    /// pixel and channel.
    void add(const std::string& layer, const std::string& names, const float* values,
             std::size_t pixels)
    {
        const std::size_t count = names.size();
        const bool halves = layer.empty() && main_type_ == Imf::HALF;
        const half* converted = halves ? to_half({values, pixels * count}) : nullptr;
        for (std::size_t c = 0; c < count; ++c) {
            std::string name = (layer.empty() ? "" : layer + ".") + names[c];
            if (!names_.insert(name).second) {
                throw Error(ErrorCode::usage,
                            fmt::format("two layers have a channel \"{}\"", name));
            }
            channels_.push_back(
                halves ? Channel{std::move(name), Imf::HALF, converted + c, count * sizeof(half)}
                       : Channel{std::move(name), Imf::FLOAT, values + c, count * sizeof(float)});
        }
    }
    [[nodiscard]] const std::vector<Channel>& channels() const { return channels_; }

private:
    const half* to_half(std::span<const float> values)
    {
        std::vector<half>& result = halves_.emplace_back();
        result.reserve(values.size());
        for (const float value : values) {
            result.push_back(half(std::min(value, max_half)));
        }
        return result.data();
    }

    Imf::PixelType main_type_;
    std::vector<Channel> channels_;
    std::set<std::string> names_;
    std::list<std::vector<half>> halves_;  // a list: channels point into its elements
};

Imf::Header make_header(const Imath::Box2i& window, const ExrPlacement& placement,
                        const Content& content, const ExrOptions& options)
{
    const Imath::Box2i display({0, 0}, {placement.full_width - 1, placement.full_height - 1});
    Imf::Header header(display, window);
    header.compression() = Imf::ZIP_COMPRESSION;
    if (options.storage == ExrStorage::tiles) {
        constexpr unsigned tile_size = 64;
        header.setTileDescription(Imf::TileDescription(tile_size, tile_size, Imf::ONE_LEVEL));
    }
    for (const Channel& channel : content.channels()) {
        header.channels().insert(channel.name, Imf::Channel(channel.type));
    }
    add_cryptomatte_metadata(header, options.manifests);
    add_exr_metadata(
        header, options.metadata,
        static_cast<float>(placement.full_width) / static_cast<float>(placement.full_height));
    return header;
}

Imf::FrameBuffer make_frame_buffer(const Imath::Box2i& window, const Content& content)
{
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    Imf::FrameBuffer buffer;
    for (const Channel& channel : content.channels()) {
        buffer.insert(channel.name,
                      Imf::Slice::Make(channel.type, channel.first, window, channel.pixel_stride,
                                       channel.pixel_stride * width));
    }
    return buffer;
}

void write_to(ExrStream& stream, const Imf::Header& header, const Imf::FrameBuffer& buffer)
{
    if (header.hasTileDescription()) {
        Imf::TiledOutputFile exr(stream, header);
        exr.setFrameBuffer(buffer);
        exr.writeTiles(0, exr.numXTiles() - 1, 0, exr.numYTiles() - 1);
        return;
    }
    Imf::OutputFile exr(stream, header);
    exr.setFrameBuffer(buffer);
    exr.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
}

Content make_content(const Image& image, std::span<const Layer> layers, const ExrOptions& options)
{
    Content content(options.type == ExrChannelType::half_float ? Imf::HALF : Imf::FLOAT);
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    content.add("", "RGB", &image.pixels.front().x, image.pixels.size());
    for (const Layer& layer : layers) {
        const std::size_t expected = image.pixels.size() * layer.channels.size();
        if (layer.width != image.width || layer.height != image.height ||
            layer.values.size() != expected) {
            throw Error(ErrorCode::usage,
                        fmt::format("layer \"{}\" has {}x{} pixels and {} values, the image "
                                    "{}x{} pixels",
                                    layer.name, layer.width, layer.height, layer.values.size(),
                                    image.width, image.height));
        }
        content.add(layer.name, layer.channels, layer.values.data(), image.pixels.size());
    }
    return content;
}

void write(const std::filesystem::path& file, int width, int height, const Content& content,
           const ExrOptions& options)
{
    const ExrPlacement placement = options.placement.value_or(
        ExrPlacement{.x = 0, .y = 0, .full_width = width, .full_height = height});
    const Imath::Box2i window = data_window(width, height, placement);
    OutputFile output(file);
    ExrStream stream(output, file.string());
    with_write_errors(file, [&] {
        write_to(stream, make_header(window, placement, content, options),
                 make_frame_buffer(window, content));
    });
    output.commit();
}

ExrReport make_report(const Image& image, const ExrOptions& options)
{
    ExrReport report;
    if (options.type == ExrChannelType::half_float) {
        for (const Rgb& pixel : image.pixels) {
            const float greatest = std::max({pixel.r, pixel.g, pixel.b});
            report.clamped_pixels += greatest > max_half ? 1u : 0u;
        }
    }
    return report;
}

}  // namespace

ExrReport write_exr(const std::filesystem::path& file, const Image& image,
                    const ExrOptions& options)
{
    return write_exr(file, image, {}, options);
}

ExrReport write_exr(const std::filesystem::path& file, const Image& image,
                    std::span<const Layer> layers, const ExrOptions& options)
{
    check_pixels(file, image.width, image.height, image.pixels.size());
    write(file, image.width, image.height, make_content(image, layers, options), options);
    return make_report(image, options);
}

void write_exr(const std::filesystem::path& file, const Layer& layer, const ExrOptions& options)
{
    const std::size_t channels = std::max<std::size_t>(layer.channels.size(), 1);
    const bool is_whole = layer.values.size() % channels == 0;
    check_pixels(file, layer.width, layer.height, is_whole ? layer.values.size() / channels : 0);
    Content content(options.type == ExrChannelType::half_float ? Imf::HALF : Imf::FLOAT);
    content.add(layer.name, layer.channels, layer.values.data(), layer.values.size() / channels);
    write(file, layer.width, layer.height, content, options);
}

}  // namespace bdpt::io
