#include <bdpt/error.h>
#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "file/read_file.h"
#include "image/encoded_image.h"
#include "process/child_process.h"
#include "process/reader_program.h"

namespace bdpt::io {

namespace {

using namespace std::string_view_literals;

// Numbers by their names in the specifications of KTX, Vulkan and the Khronos Data Format.
constexpr std::uint32_t no_supercompression = 0;
constexpr std::uint32_t basis_lz = 1;
constexpr std::uint32_t zstandard = 2;
constexpr std::uint32_t vk_format_undefined = 0;
constexpr std::uint8_t model_etc1s = 163;
constexpr std::uint8_t model_uastc = 166;
constexpr std::uint8_t transfer_linear = 1;
constexpr std::uint8_t transfer_srgb = 2;
constexpr std::uint8_t flag_alpha_premultiplied = 1;

template <typename... Values>
[[noreturn]] void fail_ktx2(fmt::format_string<Values...> text, Values&&... values)
{
    throw std::runtime_error("KTX2: " + fmt::format(text, std::forward<Values>(values)...));
}

/// Little-endian numbers of a file; reading behind its end is an error.
class Ktx2Reader {
public:
    explicit Ktx2Reader(ByteView bytes) : bytes_(bytes) {}

    [[nodiscard]] std::uint64_t number(std::size_t offset, std::size_t count) const
    {
        if (offset > bytes_.size() || count > bytes_.size() - offset) {
            fail_ktx2("ends within its header, after {} bytes", bytes_.size());
        }
        std::uint64_t result = 0;
        for (std::size_t i = count; i > 0; --i) {
            result = result << 8U | bytes_[offset + i - 1];
        }
        return result;
    }
    [[nodiscard]] std::uint8_t u8(std::size_t offset) const
    {
        return static_cast<std::uint8_t>(number(offset, 1));
    }
    [[nodiscard]] std::uint32_t u32(std::size_t offset) const
    {
        return static_cast<std::uint32_t>(number(offset, 4));
    }
    [[nodiscard]] std::uint64_t u64(std::size_t offset) const { return number(offset, 8); }

    /// Returns the bytes of a part of the file; `what` names the part.
    [[nodiscard]] ByteView part(const std::string& what, std::uint64_t offset,
                                std::uint64_t length) const
    {
        if (offset > bytes_.size() || length > bytes_.size() - offset) {
            fail_ktx2("{} has {} bytes from byte {} on, but the file ends at byte {}", what, length,
                      offset, bytes_.size());
        }
        return bytes_.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
    }

private:
    ByteView bytes_;
};

/// Fixed part of the header.
struct Ktx2Head {
    std::uint32_t format;
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t depth;
    std::uint32_t layers;
    std::uint32_t faces;
    std::uint32_t levels;
    std::uint32_t supercompression;
};

constexpr std::size_t level_index = 80;  // [bytes] from the start of the file
constexpr std::size_t level_entry = 24;  // [bytes]

Ktx2Head read_ktx2_head(const Ktx2Reader& file)
{
    return {.format = file.u32(12),
            .width = file.u32(20),
            .height = file.u32(24),
            .depth = file.u32(28),
            .layers = file.u32(32),
            .faces = file.u32(36),
            .levels = file.u32(40),
            .supercompression = file.u32(44)};
}

void check_ktx2_shape(const Ktx2Head& head)
{
    if (head.faces == 6) {
        fail_ktx2("a cube map, but a texture has one face");
    }
    if (head.depth > 0) {
        fail_ktx2("a 3D image, {} deep, but a texture is 2D", head.depth);
    }
    if (head.layers > 1) {
        fail_ktx2("an array of {} images, but a texture is one", head.layers);
    }
    if (head.faces != 1) {
        fail_ktx2("{} faces, but a texture has one", head.faces);
    }
    constexpr std::uint32_t most = 1U << 30U;  // so that sizes in bytes fit into 64 bits
    if (head.width == 0 || head.height == 0 || head.width > most || head.height > most) {
        fail_ktx2("{} x {} pixels", head.width, head.height);
    }
    const auto max_levels =
        static_cast<std::uint32_t>(std::bit_width(std::max(head.width, head.height)));
    if (head.levels > max_levels) {
        fail_ktx2("{} levels, but {} x {} pixels have {} at most", head.levels, head.width,
                  head.height, max_levels);
    }
}

/// Packing of the pixels of a level.
struct Ktx2Format {
    int channels;
    std::uint32_t block_side;   // [pixels]
    std::uint32_t block_bytes;  // 0: blocks differ in size
};

/// First block of the data format descriptor, which describes the colours.
class FormatDescriptor {
public:
    FormatDescriptor(const Ktx2Reader& file, std::uint32_t offset, std::uint32_t length)
        : block_(file.part("the data format descriptor", offset, length))
    {
        constexpr std::size_t total = 4;  // [bytes] of the length field in front
        constexpr std::size_t vendor_and_type = 4;
        const std::size_t size = length < total + head + sample ? 0 : block_.number(10, 2);
        if (size < head + sample || size > length - total || (size - head) % sample != 0 ||
            block_.number(total, vendor_and_type) != 0) {
            fail_ktx2("the data format descriptor of {} bytes is broken", length);
        }
        samples_ = (size - head) / sample;
    }

    [[nodiscard]] std::uint8_t model() const { return block_.u8(12); }
    [[nodiscard]] std::uint8_t transfer() const { return block_.u8(14); }
    [[nodiscard]] std::uint8_t flags() const { return block_.u8(15); }
    [[nodiscard]] std::size_t samples() const { return samples_; }
    [[nodiscard]] int channel(std::size_t index) const
    {
        return block_.u8(4 + head + index * sample + 3) & 15;
    }

private:
    static constexpr std::size_t head = 24;    // [bytes]
    static constexpr std::size_t sample = 16;  // [bytes]
    Ktx2Reader block_;
    std::size_t samples_ = 0;
};

[[noreturn]] void fail_by_supercompression(const char* name, std::uint32_t scheme)
{
    fail_ktx2("{} with supercompression {}, which KHR_texture_basisu does not allow", name, scheme);
}

Ktx2Format format_of_etc1s(const Ktx2Head& head, const FormatDescriptor& descriptor)
{
    constexpr int rgb = 0;
    constexpr int alpha = 15;
    if (head.supercompression != basis_lz) {
        fail_by_supercompression("ETC1S", head.supercompression);
    }
    const bool has_alpha = descriptor.samples() == 2 && descriptor.channel(1) == alpha;
    if (descriptor.channel(0) != rgb || (descriptor.samples() != 1 && !has_alpha)) {
        fail_ktx2("channels other than RGB and RGBA (the first is {}, of {})",
                  descriptor.channel(0), descriptor.samples());
    }
    return {.channels = has_alpha ? 4 : 3, .block_side = 4, .block_bytes = 0};
}

Ktx2Format format_of_uastc(const Ktx2Head& head, const FormatDescriptor& descriptor)
{
    constexpr int rgb = 0;
    constexpr int rgba = 3;
    if (head.supercompression != no_supercompression && head.supercompression != zstandard) {
        fail_by_supercompression("UASTC", head.supercompression);
    }
    const int channel = descriptor.channel(0);
    if (descriptor.samples() != 1 || (channel != rgb && channel != rgba)) {
        fail_ktx2("channels other than RGB and RGBA (the first is {}, of {})", channel,
                  descriptor.samples());
    }
    return {.channels = channel == rgba ? 4 : 3, .block_side = 4, .block_bytes = 16};
}

/// Returns the channels of VK_FORMAT_R8G8B8_UNORM, R8G8B8_SRGB, R8G8B8A8_UNORM and R8G8B8A8_SRGB.
std::optional<std::uint32_t> plain_channels(std::uint32_t format)
{
    switch (format) {
        case 23:
        case 29:
            return 3;
        case 37:
        case 43:
            return 4;
        default:
            return std::nullopt;
    }
}

Ktx2Format find_ktx2_format(const Ktx2Head& head, const FormatDescriptor& descriptor)
{
    if (head.format == vk_format_undefined && descriptor.model() == model_etc1s) {
        return format_of_etc1s(head, descriptor);
    }
    if (head.format == vk_format_undefined && descriptor.model() == model_uastc) {
        return format_of_uastc(head, descriptor);
    }
    const std::optional<std::uint32_t> channels = plain_channels(head.format);
    if (!channels) {
        fail_ktx2(
            "neither Basis Universal nor 8-bit RGB or RGBA, but VkFormat {} with colour model "
            "{}",
            head.format, descriptor.model());
    }
    if (head.supercompression != no_supercompression && head.supercompression != zstandard) {
        fail_by_supercompression("8-bit RGB", head.supercompression);
    }
    return {.channels = static_cast<int>(*channels), .block_side = 1, .block_bytes = *channels};
}

/// Checks offsets and sizes of the levels, and returns the number of pixels of all levels.
std::uint64_t check_ktx2_levels(const Ktx2Reader& file, const Ktx2Head& head,
                                const Ktx2Format& format)
{
    if (head.levels == 0 && format.block_side > 1) {
        fail_ktx2("no levels, which Basis Universal does not allow");
    }
    std::uint64_t pixels = 0;
    for (std::uint32_t level = 0; level < std::max(head.levels, 1U); ++level) {
        const std::size_t entry = level_index + level * level_entry;
        const std::uint64_t length = file.u64(entry + 8);
        const std::uint64_t unpacked = file.u64(entry + 16);
        static_cast<void>(file.part(fmt::format("level {}", level), file.u64(entry), length));
        const std::uint64_t width = std::max(head.width >> level, 1U);
        const std::uint64_t height = std::max(head.height >> level, 1U);
        const std::uint64_t side = format.block_side;
        const std::uint64_t expected =
            (width + side - 1) / side * ((height + side - 1) / side) * format.block_bytes;
        const std::uint64_t told = head.supercompression == no_supercompression ? length : unpacked;
        if (length == 0 || (format.block_bytes > 0 && told != expected)) {
            fail_ktx2("level {} of {} x {} pixels has {} bytes, but must have {}", level, width,
                      height, told, format.block_bytes > 0 ? fmt::format("{}", expected) : "some");
        }
        pixels += width * height;
    }
    return pixels;
}

void check_global_data(const Ktx2Reader& file, const Ktx2Head& head)
{
    const std::uint64_t length = file.u64(72);
    static_cast<void>(file.part("the supercompression data", file.u64(64), length));
    constexpr std::uint64_t fixed = 20;  // [bytes]
    constexpr std::uint64_t image = 20;  // [bytes] of each level
    if (head.supercompression == basis_lz && length < fixed + image * head.levels) {
        fail_ktx2("the supercompression data has {} bytes, too few for {} levels", length,
                  head.levels);
    }
}

/// Adds a remark for each key of `wanted` that has another value.
void check_ktx2_metadata(ByteView bytes, std::vector<std::string>& remarks)
{
    constexpr std::array wanted{std::pair{"KTXswizzle"sv, "rgba"sv},
                                std::pair{"KTXorientation"sv, "rd"sv}};
    const Ktx2Reader reader(bytes);
    for (std::size_t at = 0; bytes.size() - at >= 4;) {
        const std::size_t length = reader.u32(at);
        if (length > bytes.size() - at - 4) {
            fail_ktx2("its metadata is broken at byte {} of {}", at, bytes.size());
        }
        const std::string_view pair(reinterpret_cast<const char*>(bytes.data()) + at + 4, length);
        const std::string_view key = pair.substr(0, pair.find('\0'));
        std::string_view value = pair.substr(std::min(key.size() + 1, pair.size()));
        value = value.substr(0, value.find('\0'));
        for (const auto& [name, expected] : wanted) {
            if (key == name && value != expected) {
                const std::string_view start = value.substr(0, 8);
                remarks.push_back(fmt::format("{} is \"{}\"", name, start));
            }
        }
        constexpr std::size_t alignment = 4;
        at += std::min(4 + (length + alignment - 1) / alignment * alignment, bytes.size() - at);
    }
}

void add_ktx2_remarks(const Ktx2Head& head, const Ktx2Format& format,
                      const FormatDescriptor& descriptor, std::vector<std::string>& remarks)
{
    if (format.block_side == 1) {
        remarks.push_back(fmt::format("VkFormat {}, not Basis Universal", head.format));
    } else if (head.width % format.block_side != 0 || head.height % format.block_side != 0) {
        remarks.push_back(
            fmt::format("{} x {} pixels, not multiples of 4", head.width, head.height));
    }
    if ((descriptor.flags() & flag_alpha_premultiplied) != 0) {
        remarks.emplace_back("premultiplied alpha");
    }
}

ColorEncoding to_encoding(std::uint8_t transfer)
{
    return transfer == transfer_srgb     ? ColorEncoding::srgb
           : transfer == transfer_linear ? ColorEncoding::linear
                                         : ColorEncoding::unknown;
}

}  // namespace

bool is_ktx(ByteView bytes)
{
    return begins_with(bytes, "\xabKTX "sv);
}

Ktx2Header read_ktx2_header(ByteView bytes)
{
    if (!begins_with(bytes, "\xabKTX 20\xbb\r\n\x1a\n"sv)) {
        throw std::runtime_error("a KTX image, but not of version 2");
    }
    const Ktx2Reader file(bytes);
    const Ktx2Head head = read_ktx2_head(file);
    check_ktx2_shape(head);
    const FormatDescriptor descriptor(file, file.u32(48), file.u32(52));
    const Ktx2Format format = find_ktx2_format(head, descriptor);
    check_global_data(file, head);
    Ktx2Header result{.width = static_cast<int>(head.width),
                      .height = static_cast<int>(head.height),
                      .channels = format.channels,
                      .encoding = to_encoding(descriptor.transfer()),
                      .pixels = check_ktx2_levels(file, head, format),
                      .remarks = {}};
    check_ktx2_metadata(file.part("its metadata", file.u32(56), file.u32(60)), result.remarks);
    add_ktx2_remarks(head, format, descriptor, result.remarks);
    return result;
}

namespace {

/// Limits of decoding.
struct DecodingLimits {
    std::uint64_t memory;   // [bytes]
    std::uint64_t seconds;  // CPU time [s]
};

/// Returns the memory that a process may take to decode the image in `file` [bytes].
std::uint64_t decoding_memory(ByteView file, const Ktx2Header& header)
{
    // The file, its levels without supercompression, as RGBA, and the output.
    constexpr std::uint64_t bytes_per_pixel = 16;
    return 2 * file.size() + bytes_per_pixel * header.pixels;
}

DecodingLimits decoding_limits(ByteView file, const Ktx2Header& header)
{
    constexpr std::uint64_t start_seconds = 10;
    // A tenth of the speed of a slow machine.
    constexpr std::uint64_t pixels_per_second = 2'000'000;
    return {.memory = decoding_memory(file, header),
            .seconds = start_seconds + header.pixels / pixels_per_second};
}

/// Returns the program's message without its name; empty if it did not write one.
std::string own_message(const ProcessEnd& end)
{
    constexpr std::string_view own = "bdpt-read-ktx: ";
    return end.message.starts_with(own) ? end.message.substr(own.size()) : std::string();
}

[[noreturn]] void fail(const ProcessEnd& end, const DecodingLimits& limits)
{
    if (end.signal == SIGXCPU) {
        throw std::runtime_error(
            fmt::format("KTX2: broken, or too large: not decoded after {} s of a processor, the "
                        "limit for an image of its size",
                        limits.seconds));
    }
    if (end.signal == SIGKILL) {
        throw Error(ErrorCode::out_of_memory,
                    fmt::format("{} was killed while decoding, probably for lack of memory",
                                ktx_reader_name));
    }
    if (end.signal == SIGSYS) {
        throw std::runtime_error(
            "KTX2: broken: libktx was stopped when it did what decoding does not need");
    }
    if (end.signal != 0) {
        throw std::runtime_error(
            fmt::format("KTX2: broken: libktx crashed on it (signal {})", end.signal));
    }
    const std::string message = own_message(end);
    throw std::runtime_error(
        "KTX2: " + (message.empty() ? fmt::format("{} ended with code {}: {}", ktx_reader_name,
                                                  end.exit_code, end.message)
                                    : message));
}

/// Tests whether the program has opened the library.
bool is_ready(ChildProcess& reader)
{
    KtxReply reply{.start = {}};
    return reader.read(&reply, sizeof(reply)) == sizeof(reply) && reply.start == ktx_reply_start;
}

std::optional<std::string> find_obstacle(const std::string& library)
{
    try {
        ChildProcess reader(companion_file(ktx_reader_name), {library});
        if (is_ready(reader)) {
            return std::nullopt;
        }
        const ProcessEnd end = reader.wait();
        const std::string message = own_message(end);
        return !message.empty() ? message
               : end.signal != 0
                   ? fmt::format("libktx crashed when it was opened (signal {})", end.signal)
                   : fmt::format("{} is of another version, or broken: {}", ktx_reader_name,
                                 end.message);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::unsupported) {
            throw;
        }
        return fmt::format("KTX2 images are read by a separate program: {}", error.what());
    }
}

/// Returns the library that comes with this code; empty: none does.
std::string ktx_beside()
{
    return find_companion("ktx/libktx.so").value_or("").string();
}

}  // namespace

Ktx2Decoder::Ktx2Decoder(const std::optional<std::filesystem::path>& library)
    : library_(library ? library->string() : ktx_beside())
{}

const std::string* Ktx2Decoder::obstacle()
{
    if (!is_known_) {
        obstacle_ = find_obstacle(library_);
        is_known_ = true;
    }
    return obstacle_ ? &*obstacle_ : nullptr;
}

void Ktx2Decoder::decode(ByteView file, const Ktx2Header& header, std::uint8_t* texels) const
{
    const DecodingLimits limits = decoding_limits(file, header);
    ChildProcess reader(companion_file(ktx_reader_name),
                        {library_, std::to_string(header.width), std::to_string(header.height),
                         std::to_string(header.channels), std::to_string(limits.memory),
                         std::to_string(limits.seconds)},
                        file);
    const std::size_t size = static_cast<std::size_t>(header.width) *
                             static_cast<std::size_t>(header.height) *
                             static_cast<std::size_t>(header.channels);
    if (!is_ready(reader) || reader.read(texels, size) != size) {
        fail(reader.wait(), limits);
    }
    static_cast<void>(reader.wait());
}

namespace {

/// A file whose header has been checked.
class Ktx2File final : public ImageFile {
public:
    Ktx2File(ByteView bytes, const Ktx2Decoder& decoder, Ktx2Header header)
        : bytes_(bytes), decoder_(decoder), header_(std::move(header))
    {
        layout_.width = header_.width;
        layout_.height = header_.height;
        layout_.channels = header_.channels;
    }

    void read(std::uint8_t* values) override { decoder_.decode(bytes_, header_, values); }
    [[nodiscard]] const Ktx2Header* ktx2_header() const override { return &header_; }
    [[nodiscard]] std::uint64_t process_memory() const override
    {
        return decoding_memory(bytes_, header_);
    }

private:
    ByteView bytes_;
    const Ktx2Decoder& decoder_;
    Ktx2Header header_;
};

}  // namespace

std::unique_ptr<ImageFile> open_ktx2(ByteView bytes, Ktx2Decoder* decoder)
{
    Ktx2Header header = read_ktx2_header(bytes);
    if (decoder == nullptr) {
        throw std::runtime_error("KTX2 images are read as textures of materials only");
    }
    if (const std::string* const obstacle = decoder->obstacle()) {
        throw std::runtime_error(*obstacle);
    }
    return std::make_unique<Ktx2File>(bytes, *decoder, std::move(header));
}

}  // namespace bdpt::io
