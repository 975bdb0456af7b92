#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <bdpt/error.h>
#include <bdpt/io/part_file.h>
#include <bdpt/io/read_limits.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <new>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "file/messages.h"
#include "file/read_file.h"
#include "image/linear/image_readers.h"
#include "part/part_contents.h"

namespace bdpt::io {
namespace {

constexpr std::uint64_t max_header_bytes = 64 << 20;
constexpr int max_image_side = 1 << 16;  // [pixels]
/// No line of zeros compresses better; a file that claims so would only take our memory.
constexpr std::uint64_t max_compression = 1100;

/// Lets OpenEXR read a sealed file. OpenEXR asks for the texts of a header letter by letter.
class SealedStream : public Imf::IStream {
public:
    explicit SealedStream(const SealedFile& file) : Imf::IStream("part"), file_(file) {}

    bool read(char target[], int count) override
    {
        const auto wanted = static_cast<std::uint64_t>(count);
        if (position_ > file_.size() || wanted > file_.size() - position_) {
            throw std::runtime_error("the file is truncated");
        }
        if (wanted > block_.size()) {
            file_.read(position_, {target, static_cast<std::size_t>(count)});
        } else {
            const char* first = buffered(wanted);
            std::copy(first, first + count, target);
        }
        position_ += wanted;
        return position_ < file_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

private:
    /// Returns the next `count` bytes, which are in the file.
    const char* buffered(std::uint64_t count)
    {
        if (position_ < begin_ || position_ + count > end_) {
            begin_ = position_;
            end_ = std::min(position_ + block_.size(), file_.size());
            file_.read(begin_, {block_.data(), static_cast<std::size_t>(end_ - begin_)});
        }
        return block_.data() + (position_ - begin_);
    }

    const SealedFile& file_;
    std::uint64_t position_ = 0;
    std::array<char, 4096> block_;  // what the file has from begin_ to end_
    std::uint64_t begin_ = 0;
    std::uint64_t end_ = 0;
};

/// Checks the header before OpenEXR allocates memory by it.
void check_file_header(const SealedFile& file)
{
    Bytes bytes(static_cast<std::size_t>(std::min(file.size(), max_header_bytes)));
    file.read(0, {reinterpret_cast<char*>(bytes.data()), bytes.size()});
    ReadLimits limits;
    limits.image_side = max_image_side;
    check_exr_header(bytes, limits);
}

[[noreturn]] void fail(const char* what)
{
    throw Error(ErrorCode::invalid_input, what);
}

PartHeader read_header(const Imf::MultiPartInputFile& exr)
{
    constexpr const char* no_part = "is an OpenEXR file, but not a part of a render";
    if (exr.parts() != 2) {
        fail(no_part);
    }
    // OpenEXR's own templates for this would become symbols of our library.
    const auto found = exr.header(1).find("bdpt.part");
    const auto* text = found != exr.header(1).end()
                           ? dynamic_cast<const Imf::StringAttribute*>(&found.attribute())
                           : nullptr;
    if (text == nullptr) {
        fail(no_part);
    }
    return parse_part_header(text->value());
}

/// Checks that the planes of the file are those of the header.
void check_planes(const Imf::Header& exr, const PartHeader& header, const SealedFile& file)
{
    const PixelRect& r = header.layout.region;
    const bool has_window = exr.dataWindow() == Imath::Box2i({r.x0, r.y0}, {r.x1 - 1, r.y1 - 1});
    if (!has_window || !exr.hasType() || exr.type() != Imf::SCANLINEIMAGE) {
        fail("its sums do not match the film in its header");
    }
    std::size_t channels = 0;
    for (auto i = exr.channels().begin(); i != exr.channels().end(); ++i) {
        const Imf::Channel& channel = i.channel();
        if (channel.type != Imf::UINT || channel.xSampling != 1 || channel.ySampling != 1) {
            fail("its sums have channels that no part has");
        }
        ++channels;
    }
    // Before the names of all expected channels take memory.
    if (std::accumulate(header.ranks.begin(), header.ranks.end(), header.strategies.size()) >
        channels) {
        fail("its sums have channels that no part has");
    }
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(r.width()) * static_cast<std::uint64_t>(r.height());
    if (pixels * channels * sizeof(std::uint32_t) > max_compression * file.size()) {
        fail("claims more pixels than it can hold");
    }
    // Films of one pixel have the names.
    PartHeader pixel = header;
    pixel.layout.width = 1;
    pixel.layout.height = 1;
    pixel.layout.region = {.x0 = 0, .y0 = 0, .x1 = 1, .y1 = 1};
    const RenderResult small = make_part(pixel);
    const std::vector<std::string> wanted = PlaneRow(small, header.ranks).channels();
    const bool all = std::all_of(wanted.begin(), wanted.end(), [&exr](const std::string& name) {
        return exr.channels().findChannel(name) != nullptr;
    });
    const std::set<std::string> different(wanted.begin(), wanted.end());
    if (!all || different.size() != wanted.size() || channels != wanted.size()) {
        fail("its sums have channels that no part has");
    }
}

/// Charges the memory of the films, and of the image that they are developed to.
void spend_films(MemoryBudget& memory, const Imf::Header& exr, const PixelRect& region)
{
    std::uint64_t pixel = sizeof(Rgb);
    for (auto i = exr.channels().begin(); i != exr.channels().end(); ++i) {
        pixel += sizeof(std::uint32_t);
    }
    memory.spend(fmt::format("its film of {}x{} pixels", region.width(), region.height()),
                 pixel * static_cast<std::uint64_t>(region.width()) *
                     static_cast<std::uint64_t>(region.height()));
}

void merge_header(RenderResult& part, const PartHeader& header)
{
    if (part.samples.empty()) {
        part = make_part(header);
    }
    if (const auto what = difference(part.identity, header.identity)) {
        fail(("is of another render: " + *what).c_str());
    }
    if (const SampleSet both = part.samples.overlap(header.samples); !both.empty()) {
        fail(("has samples that are already included: " + both.text()).c_str());
    }
    if (part.film.layout() != header.layout || part.aovs.aovs() != header.aovs ||
        part.aovs.counts() != header.counts || part.strategies.strategies() != header.strategies ||
        part.ids.names() != header.names) {
        fail("its films do not match its render");
    }
    for (const SampleRange& range : header.samples.ranges()) {
        part.film.count_samples(range.begin, range.end);
        part.strategies.count_samples(range.end - range.begin);
    }
    part.film.add_totals(header.totals);
    part.samples.add(header.samples);
    part.stats += header.stats;
    part.cpu_seconds += header.cpu_seconds;
}

/// Returns what `read` makes of the open file. Failures become an `Error` that names the file.
template <typename Read>
auto with_part_file(const std::filesystem::path& path, const Read& read)
{
    return with_named_errors(path, [&] {
        const SealedFile file(path);
        return with_library_errors(ErrorCode::invalid_input, "OpenEXR: ", [&] {
            check_file_header(file);
            SealedStream stream(file);
            Imf::MultiPartInputFile exr(stream);
            return read(exr, file);
        });
    });
}

}  // namespace

PartInfo read_part_info(const std::filesystem::path& path)
{
    return with_part_file(path, [&](Imf::MultiPartInputFile& exr, const SealedFile& file) {
        PartHeader header = read_header(exr);
        check_planes(exr.header(1), header, file);
        return PartInfo{.file = path,
                        .identity = std::move(header.identity),
                        .samples = std::move(header.samples),
                        .notes = std::move(header.notes),
                        .hash = file.hash()};
    });
}

void merge_part(RenderResult& part, const PartInfo& info, MemoryBudget* memory)
{
    with_part_file(info.file, [&](Imf::MultiPartInputFile& exr, const SealedFile& file) {
        if (file.hash() != info.hash) {
            fail("was replaced while it was in use; run the command again");
        }
        const PartHeader header = read_header(exr);
        check_planes(exr.header(1), header, file);
        if (memory != nullptr && part.samples.empty()) {
            spend_films(*memory, exr.header(1), header.layout.region);
        }
        merge_header(part, header);
        Imf::InputPart input(exr, 1);
        PlaneRow row(part, header.ranks);
        input.setFrameBuffer(row.frame_buffer());
        const int top = header.layout.region.y0;
        for (int y = 0; y < part.film.height(); ++y) {
            input.readPixels(top + y);
            row.add_to(part, y, header.samples.count());
        }
        return 0;
    });
}

}  // namespace bdpt::io
