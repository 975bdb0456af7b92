#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <bdpt/io/part_file.h>
#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <string>

#include "output/exr_output.h"
#include "output/image_output.h"
#include "part/part_contents.h"

namespace bdpt::io {
namespace {

constexpr std::array image_channels{"R", "G", "B"};

Imf::Header make_header(const FilmLayout& layout, const char* name)
{
    const PixelRect& r = layout.region;
    Imf::Header header(Imath::Box2i({0, 0}, {layout.width - 1, layout.height - 1}),
                       Imath::Box2i({r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}));
    header.setName(name);
    header.setType(Imf::SCANLINEIMAGE);
    Imf::addChromaticities(header, Imf::Chromaticities{});  // parts of a file share them
    return header;
}

Imf::Header image_header(const RenderResult& part, const PartNotes& notes)
{
    const FilmLayout& layout = part.film.layout();
    Imf::Header header = make_header(layout, "image");
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const char* channel : image_channels) {
        header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    }
    ImageMetadata metadata = notes.metadata;
    metadata.samples_per_pixel = part.samples.count();
    metadata.render_seconds = part.cpu_seconds;
    add_exr_metadata(header, metadata,
                     static_cast<float>(layout.width) / static_cast<float>(layout.height));
    return header;
}

Imf::Header sums_header(const RenderResult& part, const PartNotes& notes, const PlaneRow& row)
{
    Imf::Header header = make_header(part.film.layout(), "sums");
    // Single-line blocks: memory does not grow with channels times lines.
    header.compression() = Imf::ZIPS_COMPRESSION;
    for (const std::string& channel : row.channels()) {
        header.channels().insert(channel, Imf::Channel(Imf::UINT));
    }
    header.insert("bdpt.part", Imf::StringAttribute(to_text(make_part_header(part, notes))));
    return header;
}

void write_image(Imf::MultiPartOutputFile& file, const Film& film)
{
    const Image image = film.develop();
    const auto width = static_cast<std::size_t>(film.width());
    const PixelRect& r = film.region();
    const Imath::Box2i window({r.x0, r.y0}, {r.x1 - 1, r.y1 - 1});
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < image_channels.size(); ++c) {
        buffer.insert(image_channels[c],
                      Imf::Slice::Make(Imf::FLOAT, &image.pixels.front().x + c, window, sizeof(Rgb),
                                       sizeof(Rgb) * width));
    }
    Imf::OutputPart output(file, 0);
    output.setFrameBuffer(buffer);
    output.writePixels(film.height());
}

void write_sums(Imf::MultiPartOutputFile& file, const RenderResult& part, PlaneRow& row)
{
    Imf::OutputPart output(file, 1);
    output.setFrameBuffer(row.frame_buffer());
    for (int y = 0; y < part.film.height(); ++y) {
        row.take(part, y);
        output.writePixels(1);
    }
}

/// Tests whether the existing file is ahead of `part`. Throws `Error` (output) if it belongs to
/// another render.
bool is_ahead(const std::filesystem::path& file, const RenderResult& part)
{
    std::optional<PartInfo> there;
    try {
        there = read_part_info(file);
    } catch (const Error&) {
        return false;  // missing, or not worth keeping
    }
    if (const auto what = difference(part.identity, there->identity)) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot write: this is now a part of another render: {}",
                                file.string(), *what));
    }
    return there->samples.contains(part.samples) && there->samples != part.samples;
}

}  // namespace

PartWrite write_part(const std::filesystem::path& file, const RenderResult& part,
                     const PartNotes& notes, OldPart old)
{
    OutputFile output(file);
    with_write_errors(file, [&] {
        ExrStream stream(output, file.string());
        PlaneRow row(part, part.ids.ranks());
        const std::array headers{image_header(part, notes), sums_header(part, notes, row)};
        Imf::MultiPartOutputFile exr(stream, headers.data(), static_cast<int>(headers.size()));
        write_image(exr, part.film);
        write_sums(exr, part, row);
    });
    seal(output, output.size());
    if (old == OldPart::keep_if_more && is_ahead(file, part)) {
        return PartWrite::kept;
    }
    output.commit();
    return PartWrite::written;
}

}  // namespace bdpt::io
