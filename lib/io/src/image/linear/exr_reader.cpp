#include <ImathBox.h>
#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>
#include <bdpt/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <exception>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/linear/image_readers.h"

namespace bdpt::io {
namespace {

/// Names of the channels of one layer that together are colours.
struct ColorChannels {
    std::string prefix;                ///< prefix of the layer, with a dot, or empty
    std::array<std::string, 3> names;  ///< in full; grey: only the first
    bool chroma = false;               ///< RY and BY in addition to Y

    [[nodiscard]] bool grey() const { return names[1].empty(); }
};

bool has(const Imf::ChannelList& channels, const std::string& name)
{
    return channels.findChannel(name.c_str()) != nullptr;
}

/// Returns the part of a channel's name before the last dot, with the dot; empty without a dot.
std::string find_prefix(const std::string& channel)
{
    const std::size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot + 1);
}

std::optional<ColorChannels> find_triple(const Imf::ChannelList& channels,
                                         const std::string& prefix, std::string_view letters)
{
    ColorChannels result{.prefix = prefix, .names = {}};
    for (std::size_t c = 0; c < letters.size(); ++c) {
        result.names[c] = prefix + letters[c];
        if (!has(channels, result.names[c])) {
            return std::nullopt;
        }
    }
    return result;
}

/// Returns all layers, for the message that a layer does not exist.
std::string all_layers(const Imf::ChannelList& channels)
{
    std::set<std::string> names;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string prefix = find_prefix(channel.name());
        names.insert(prefix.empty() ? channel.name() : prefix.substr(0, prefix.size() - 1));
    }
    return fmt::format("\"{}\"", fmt::join(names, "\", \""));
}

/// Finds channels R, G, B, or else Y with or without RY and BY, of the unnamed layer or else of the
/// first that has them; none if there are no such channels.
std::optional<ColorChannels> find_colors(const Imf::ChannelList& channels)
{
    // Every channel's prefix is a candidate; the empty one, if any, comes first.
    std::vector<std::string> prefixes{""};
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string prefix = find_prefix(channel.name());
        if (!prefix.empty()) {
            prefixes.push_back(prefix);
        }
    }
    for (const std::string& prefix : prefixes) {
        if (const auto colors = find_triple(channels, prefix, "RGB")) {
            return colors;
        }
    }
    for (const std::string& prefix : prefixes) {
        if (has(channels, prefix + "Y")) {
            const bool chroma = has(channels, prefix + "RY") && has(channels, prefix + "BY");
            return ColorChannels{.prefix = prefix, .names = {prefix + "Y"}, .chroma = chroma};
        }
    }
    return std::nullopt;
}

/// Finds the channels of layer `name`: R, G, B; or X, Y, Z in their place; or the only one, as
/// grey. A channel without a layer is found by its own name. Throws `Error`: not_found if there is
/// no such layer, unsupported if it has other channels.
ColorChannels find_layer(const Imf::ChannelList& channels, const std::string& name)
{
    const std::string prefix = name + ".";
    for (const std::string_view letters : {"RGB", "XYZ"}) {
        if (const auto colors = find_triple(channels, prefix, letters)) {
            return *colors;
        }
    }
    if (has(channels, name)) {
        return ColorChannels{.prefix = "", .names = {name}};
    }
    std::vector<std::string> own;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        if (find_prefix(channel.name()) == prefix) {
            own.emplace_back(channel.name());
        }
    }
    if (own.empty()) {
        throw Error(ErrorCode::not_found,
                    fmt::format("no layer \"{}\"; the file has {}", name, all_layers(channels)));
    }
    if (own.size() > 1) {
        throw Error(ErrorCode::unsupported,
                    fmt::format("layer \"{}\" has the channels {}: neither R, G, B nor X, Y, Z "
                                "nor a single one",
                                name, fmt::join(own, ", ")));
    }
    return ColorChannels{.prefix = prefix, .names = {own.front()}};
}

/// A file in memory.
class MemoryStream : public Imf::IStream {
public:
    explicit MemoryStream(ByteView bytes) : Imf::IStream("picture"), bytes_(bytes) {}

    bool read(char target[], int count) override
    {
        const auto wanted = static_cast<std::size_t>(count);
        if (wanted > bytes_.size() - position_) {
            throw std::runtime_error("the file is truncated");
        }
        std::memcpy(target, bytes_.data() + position_, wanted);
        position_ += wanted;
        return position_ < bytes_.size();
    }

    std::uint64_t tellg() override { return position_; }

    void seekg(std::uint64_t position) override
    {
        if (position > bytes_.size()) {
            throw std::runtime_error("the file is truncated");
        }
        position_ = static_cast<std::size_t>(position);
    }

private:
    ByteView bytes_;
    std::size_t position_ = 0;
};

struct Window {
    int width = 0;
    int height = 0;
};

Window checked_size(const Imath::Box2i& box, const ReadLimits& limits, const MemoryBudget* memory)
{
    const std::int64_t width = std::int64_t{box.max.x} - box.min.x + 1;
    const std::int64_t height = std::int64_t{box.max.y} - box.min.y + 1;
    const std::int64_t most = limits.image_side;
    if (width < 1 || height < 1 || width > most || height > most) {
        throw Error(
            ErrorCode::invalid_input,
            fmt::format("image of {} x {} pixels; 1 to {} a side are read", width, height, most));
    }
    const Window window{static_cast<int>(width), static_cast<int>(height)};
    check_image_size(window.width, window.height, sizeof(Rgb), limits, memory);
    return window;
}

/// Reads the channels of the part `box` in single precision, whatever their type in the file.
void read_part(Imf::InputFile& input, const ColorChannels& colors, const Imath::Box2i& box,
               std::span<Rgb> pixels)
{
    Imf::FrameBuffer buffer;
    const std::size_t row = sizeof(Rgb) * static_cast<std::size_t>(box.max.x - box.min.x + 1);
    for (std::size_t c = 0; c < colors.names.size() && !colors.names[c].empty(); ++c) {
        auto* const base = reinterpret_cast<char*>(&pixels[0][static_cast<int>(c)]);
        buffer.insert(colors.names[c].c_str(),
                      Imf::Slice::Make(Imf::FLOAT, base, box, sizeof(Rgb), row));
    }
    input.setFrameBuffer(buffer);
    input.readPixels(box.min.y, box.max.y);
    if (colors.grey()) {
        for (Rgb& pixel : pixels) {
            pixel = Rgb(pixel[0]);
        }
    }
}

std::vector<Rgb> read_channels(Imf::InputFile& input, const ColorChannels& colors,
                               const Imath::Box2i& box, const Window& window)
{
    std::vector<Rgb> pixels(
        static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height),
        Rgb(0.0f));
    read_part(input, colors, box, pixels);
    return pixels;
}

/// Reads luminance with subsampled chroma: OpenEXR itself reconstructs the colours, in half
/// precision.
std::vector<Rgb> read_chroma(ByteView file, const std::string& prefix, const Imath::Box2i& box,
                             const Window& window)
{
    MemoryStream stream(file);
    const std::string layer = prefix.empty() ? prefix : prefix.substr(0, prefix.size() - 1);
    Imf::RgbaInputFile input(stream, layer, 0);
    Imf::Array2D<Imf::Rgba> rgba(window.height, window.width);
    const std::ptrdiff_t origin =
        std::ptrdiff_t{box.min.x} + std::ptrdiff_t{box.min.y} * std::ptrdiff_t{window.width};
    input.setFrameBuffer(&rgba[0][0] - origin, 1, static_cast<std::size_t>(window.width));
    input.readPixels(box.min.y, box.max.y);
    std::vector<Rgb> pixels;
    pixels.reserve(static_cast<std::size_t>(window.width) *
                   static_cast<std::size_t>(window.height));
    for (int y = 0; y < window.height; ++y) {
        for (int x = 0; x < window.width; ++x) {
            const Imf::Rgba& pixel = rgba[y][x];
            pixels.emplace_back(pixel.r, pixel.g, pixel.b);
        }
    }
    return pixels;
}

/// Places the data window in the display window.
Image place(std::vector<Rgb> pixels, const Imath::Box2i& data, const Imath::Box2i& display,
            const Window& data_size, const Window& size)
{
    Image image{size.width, size.height, {}};
    if (data == display) {
        image.pixels = std::move(pixels);
        return image;
    }
    image.pixels.resize(
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height), Rgb(0.0f));
    const int left = std::max(data.min.x, display.min.x);
    const int right = std::min(data.max.x, display.max.x);
    for (int y = std::max(data.min.y, display.min.y); y <= std::min(data.max.y, display.max.y);
         ++y) {
        const auto from = static_cast<std::ptrdiff_t>(y - data.min.y) * data_size.width;
        const auto to = static_cast<std::ptrdiff_t>(y - display.min.y) * size.width;
        if (left <= right) {
            std::copy(pixels.begin() + from + (left - data.min.x),
                      pixels.begin() + from + (right - data.min.x) + 1,
                      image.pixels.begin() + to + (left - display.min.x));
        }
    }
    return image;
}

/// Returns the part of the display window that has data, with the window's corner at (0, 0).
PixelRect filled_part(const Imath::Box2i& data, const Imath::Box2i& display)
{
    const auto size = [](int low, int high) { return std::max(high - low + 1, 0); };
    const int left = std::max(data.min.x, display.min.x);
    const int top = std::max(data.min.y, display.min.y);
    PixelRect rect{.x0 = left - display.min.x, .y0 = top - display.min.y, .x1 = 0, .y1 = 0};
    rect.x1 = rect.x0 + size(left, std::min(data.max.x, display.max.x));
    rect.y1 = rect.y0 + size(top, std::min(data.max.y, display.max.y));
    return rect;
}

std::vector<std::pair<std::string, std::string>> read_attributes(const Imf::Header& header)
{
    std::vector<std::pair<std::string, std::string>> result;
    for (auto entry = header.begin(); entry != header.end(); ++entry) {
        const Imf::Attribute& attribute = entry.attribute();
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute)) {
            result.emplace_back(entry.name(), text->value());
        } else if (const auto* number = dynamic_cast<const Imf::IntAttribute*>(&attribute)) {
            result.emplace_back(entry.name(), fmt::format("{}", number->value()));
        } else if (const auto* real = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) {
            result.emplace_back(entry.name(), fmt::format("{}", real->value()));
        }
    }
    return result;
}

/// Returns the channels of `layer`, or those of the image itself.
ColorChannels choose_channels(const Imf::ChannelList& channels,
                              const std::optional<std::string>& layer, Warnings& warnings)
{
    if (layer) {
        return find_layer(channels, *layer);
    }
    const std::optional<ColorChannels> colors = find_colors(channels);
    if (!colors) {
        throw Error(ErrorCode::unsupported, "neither R, G, B nor Y channels");
    }
    if (!colors->prefix.empty()) {
        warnings.add("only one layer is read",
                     "layer " + colors->prefix.substr(0, colors->prefix.size() - 1));
    }
    return *colors;
}

/// Tests whether all channels of the colours are half floats.
bool are_halves(const Imf::ChannelList& channels, const ColorChannels& colors)
{
    return !colors.chroma &&
           std::all_of(colors.names.begin(), colors.names.end(), [&](const std::string& name) {
               return name.empty() || channels.findChannel(name.c_str())->type == Imf::HALF;
           });
}

bool read_half_rows(ByteView file, const ReadLimits& limits, Warnings& warnings,
                    const RowSink& sink)
{
    check_exr_header(file, limits);
    MemoryStream stream(file);
    Imf::InputFile input(stream, 0);
    const Imf::Header& header = input.header();
    const Imath::Box2i box = header.dataWindow();
    if ((header.hasType() && Imf::isDeepData(header.type())) || box != header.displayWindow()) {
        return false;
    }
    const ColorChannels colors = choose_channels(header.channels(), std::nullopt, warnings);
    if (!are_halves(header.channels(), colors)) {
        return false;
    }
    const Window size = checked_size(box, limits, nullptr);
    sink.begin(size.width, size.height);
    // Whole blocks of any compression, so that none is decoded twice.
    constexpr int rows_of_part = 256;
    const auto width = static_cast<std::size_t>(size.width);
    std::vector<Rgb> pixels(width * static_cast<std::size_t>(std::min(rows_of_part, size.height)));
    for (int y = 0; y < size.height; y += rows_of_part) {
        const int rows = std::min(rows_of_part, size.height - y);
        const Imath::Box2i part({box.min.x, box.min.y + y}, {box.max.x, box.min.y + y + rows - 1});
        std::fill(pixels.begin(), pixels.end(), Rgb(0.0f));
        read_part(input, colors, part,
                  std::span(pixels).first(width * static_cast<std::size_t>(rows)));
        for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
            if (!sink.add(std::span(pixels).subspan(row * width, width))) {
                return false;
            }
        }
    }
    return true;
}

ExrImage read(ByteView file, const std::optional<std::string>& layer, const ReadLimits& limits,
              Warnings& warnings, const MemoryBudget* memory)
{
    check_exr_header(file, limits);
    MemoryStream stream(file);
    Imf::InputFile input(stream, 0);
    const Imf::Header& header = input.header();
    if (header.hasType() && Imf::isDeepData(header.type())) {
        throw Error(ErrorCode::unsupported, "deep OpenEXR files are not supported");
    }
    const ColorChannels colors = choose_channels(header.channels(), layer, warnings);
    const Imath::Box2i data = header.dataWindow();
    const Imath::Box2i display = header.displayWindow();
    const Window data_size = checked_size(data, limits, memory);
    const Window size = checked_size(display, limits, memory);
    std::vector<Rgb> pixels = colors.chroma ? read_chroma(file, colors.prefix, data, data_size)
                                            : read_channels(input, colors, data, data_size);
    return {.image = place(std::move(pixels), data, display, data_size, size),
            .filled = filled_part(data, display),
            .halves = colors.chroma || are_halves(header.channels(), colors),
            .attributes = read_attributes(header)};
}

}  // namespace

bool is_exr(ByteView file)
{
    return begins_with(file, "\x76\x2f\x31\x01");
}

ExrImage read_exr(ByteView file, const std::optional<std::string>& layer, const ReadLimits& limits,
                  Warnings& warnings, const MemoryBudget* memory)
{
    return with_library_errors(ErrorCode::invalid_input, "OpenEXR: ", [&] {
        return read(file, layer, limits, warnings, memory);
    });
}

bool read_half_exr_rows(ByteView file, const ReadLimits& limits, Warnings& warnings,
                        const RowSink& sink)
{
    return with_library_errors(ErrorCode::invalid_input, "OpenEXR: ", [&] {
        return read_half_rows(file, limits, warnings, sink);
    });
}

}  // namespace bdpt::io
