#include <bdpt/io/exr.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "camera_matrices.h"
#include "check_pixels.h"

namespace bdpt::io {
namespace {

constexpr float largest_half = 65504.0f;
constexpr std::array<const char*, 3> channel_names{"R", "G", "B"};

/// Lets OpenEXR write into an `OutputFile`, which reports errors that it would swallow.
class OutputStream : public Imf::OStream {
public:
    OutputStream(OutputFile& file, const std::string& name)
        : Imf::OStream(name.c_str()), file_(file)
    {}
    void write(const char bytes[], int count) override
    {
        file_.write({bytes, static_cast<std::size_t>(count)});
    }
    uint64_t tellp() override { return file_.position(); }
    void seekp(uint64_t position) override { file_.seek(position); }

private:
    OutputFile& file_;
};

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

void add_metadata(Imf::Header& header, const PictureMetadata& metadata, float aspect)
{
    const float seconds = static_cast<float>(metadata.render_seconds);
    const int samples = static_cast<int>(
        std::min<std::int64_t>(metadata.samples_per_pixel, std::numeric_limits<int>::max()));

    Imf::addChromaticities(header, Imf::Chromaticities{});  // whose default is Rec. 709
    Imf::addWhiteLuminance(header, 1.0f);                   // pixels are in nit
    const std::time_t created = std::chrono::system_clock::to_time_t(metadata.created);
    Imf::addCapDate(header, fmt::format("{:%Y:%m:%d %H:%M:%S}", fmt::gmtime(created)));
    Imf::addUtcOffset(header, 0.0f);
    Imf::addWorldToCamera(header, to_imath(camera_from_world(metadata.camera)));
    Imf::addWorldToNDC(header, to_imath(ndc_from_world(metadata.camera, aspect)));

    header.insert("software", Imf::StringAttribute(software_name(metadata)));
    for (const auto& [name, text] : text_entries(metadata)) {
        header.insert(name.c_str(), Imf::StringAttribute(text));
    }
    header.insert("bdpt.spp", Imf::IntAttribute(samples));
    header.insert("bdpt.renderTimeSeconds", Imf::FloatAttribute(seconds));
    header.insert("samplesPerPixel", Imf::IntAttribute(samples));
    header.insert("renderTimeSeconds", Imf::FloatAttribute(seconds));
}

Imf::Header make_header(const Image& image, const ExrOptions& options)
{
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    const Imf::PixelType type = options.type == ExrChannelType::half_float ? Imf::HALF : Imf::FLOAT;
    for (const char* name : channel_names) {
        header.channels().insert(name, Imf::Channel(type));
    }
    add_metadata(header, options.metadata,
                 static_cast<float>(image.width) / static_cast<float>(image.height));
    return header;
}

/// OpenEXR's slices point to non-const memory, which it does not change when it writes.
template <typename Component>
Imf::FrameBuffer make_frame_buffer(const Component* components, Imf::PixelType type, int width)
{
    constexpr std::size_t pixel_size = 3 * sizeof(Component);
    Imf::FrameBuffer buffer;
    for (std::size_t channel = 0; channel < channel_names.size(); ++channel) {
        buffer.insert(
            channel_names[channel],
            Imf::Slice(type, const_cast<char*>(reinterpret_cast<const char*>(components + channel)),
                       pixel_size, pixel_size * static_cast<std::size_t>(width)));
    }
    return buffer;
}

struct HalfPixels {
    std::vector<half> components;
    ExrReport report;
};

HalfPixels to_half(const Image& image)
{
    HalfPixels result;
    result.components.reserve(3 * image.pixels.size());
    for (const Rgb& pixel : image.pixels) {
        bool clamped = false;
        for (int channel = 0; channel < 3; ++channel) {
            const float value = pixel[channel];
            clamped = clamped || value > largest_half;
            result.components.push_back(value > largest_half ? half(largest_half) : half(value));
        }
        result.report.clamped_pixels += clamped ? 1u : 0u;
    }
    return result;
}

void write_pixels(OutputStream& stream, const Image& image, const ExrOptions& options,
                  const Imf::FrameBuffer& buffer)
{
    Imf::OutputFile exr(stream, make_header(image, options));
    exr.setFrameBuffer(buffer);
    exr.writePixels(image.height);
}

ExrReport write_to(OutputStream& stream, const Image& image, const ExrOptions& options)
{
    if (options.type == ExrChannelType::half_float) {
        const HalfPixels pixels = to_half(image);
        write_pixels(stream, image, options,
                     make_frame_buffer(pixels.components.data(), Imf::HALF, image.width));
        return pixels.report;
    }
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    write_pixels(stream, image, options,
                 make_frame_buffer(&image.pixels.front().x, Imf::FLOAT, image.width));
    return {};
}

}  // namespace

ExrReport write_exr(const std::filesystem::path& file, const Image& image,
                    const ExrOptions& options)
{
    check_pixels(file, image.width, image.height, image.pixels.size());
    OutputFile output(file);
    OutputStream stream(output, file.string());
    ExrReport report;
    try {
        report = write_to(stream, image, options);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& failure) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot write: {}", file.string(), failure.what()));
    }
    output.commit();
    return report;
}

}  // namespace bdpt::io
