#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "file/read_file.h"
#include "gltf/compression/compression.h"

namespace bdpt::io {

void DecodedSize::add(const JsonPlace& place, std::uint64_t count, std::uint64_t size,
                      std::uint64_t encoded)
{
    // Small meshes of few different values legitimately have a very high compression ratio.
    constexpr std::uint64_t harmless = std::uint64_t{64} << 20;
    if (size != 0 && count > left() / size) {
        const long double need = static_cast<long double>(count) * static_cast<long double>(size);
        place.fail(fmt::format("{} elements become {}, but the limit for all buffers is {}", count,
                               human_bytes(need),
                               human_bytes(static_cast<long double>(limits_.buffer_bytes))));
    }
    const std::uint64_t bytes = count * size;
    if (bytes > harmless && bytes / limits_.compression_ratio > encoded) {
        place.fail(fmt::format("{} in {} bytes: more than {} times packed",
                               human_bytes(static_cast<long double>(bytes)), encoded,
                               limits_.compression_ratio));
    }
    memory_.spend(place.pointer(), bytes);
    total_ += bytes;
}

namespace {

constexpr std::string_view extension_names[] = {"EXT_meshopt_compression",
                                                "KHR_meshopt_compression"};

/// Returns the extension that compresses a view, if any.
std::optional<std::string_view> find_compression(const JsonPlace& view)
{
    if (!view.has("extensions")) {
        return std::nullopt;
    }
    const JsonPlace extensions = view.member("extensions");
    for (const std::string_view name : extension_names) {
        if (extensions.has(name)) {
            return name;
        }
    }
    return std::nullopt;
}

MeshoptMode read_mode(const JsonPlace& place)
{
    if (place.value() == "ATTRIBUTES") {
        return MeshoptMode::attributes;
    }
    if (place.value() == "TRIANGLES") {
        return MeshoptMode::triangles;
    }
    if (place.value() == "INDICES") {
        return MeshoptMode::indices;
    }
    place.fail(brief(place.value()) + " is not a mode");
}

MeshoptFilter read_filter(const JsonPlace& packed)
{
    if (!packed.has("filter")) {
        return MeshoptFilter::none;
    }
    const JsonPlace place = packed.member("filter");
    if (place.value() == "NONE") {
        return MeshoptFilter::none;
    }
    if (place.value() == "OCTAHEDRAL") {
        return MeshoptFilter::octahedral;
    }
    if (place.value() == "QUATERNION") {
        return MeshoptFilter::quaternion;
    }
    if (place.value() == "EXPONENTIAL") {
        return MeshoptFilter::exponential;
    }
    if (place.value() == "COLOR") {
        place.fail("the filter \"COLOR\" is not supported", ErrorCode::unsupported);
    }
    place.fail(brief(place.value()) + " is not a filter");
}

bool stride_fits(const MeshoptStream& stream)
{
    if (stream.mode != MeshoptMode::attributes) {
        return stream.stride == 2 || stream.stride == 4;
    }
    switch (stream.filter) {
        case MeshoptFilter::octahedral:
            return stream.stride == 4 || stream.stride == 8;
        case MeshoptFilter::quaternion:
            return stream.stride == 8;
        default:
            return stream.stride > 0 && stream.stride <= 256 && stream.stride % 4 == 0;
    }
}

/// Reads the stream's properties and checks what the decoder relies on.
MeshoptStream read_stream(const JsonPlace& packed)
{
    MeshoptStream stream;
    stream.mode = read_mode(packed.member("mode"));
    stream.filter = read_filter(packed);
    stream.count = static_cast<std::size_t>(packed.member("count").as_unsigned());
    const JsonPlace stride = packed.member("byteStride");
    stream.stride = static_cast<std::size_t>(stride.as_unsigned());
    if (stream.mode != MeshoptMode::attributes && stream.filter != MeshoptFilter::none) {
        packed.member("filter").fail("filters need the mode ATTRIBUTES");
    }
    if (!stride_fits(stream)) {
        stride.fail(fmt::format("{} does not fit this mode and filter", stream.stride));
    }
    if (stream.mode == MeshoptMode::triangles && stream.count % 3 != 0) {
        packed.member("count").fail(fmt::format("{} is not a multiple of 3", stream.count));
    }
    return stream;
}

ByteView encoded_bytes(const JsonPlace& packed, const std::vector<Bytes>& buffers)
{
    const auto index = static_cast<std::size_t>(packed.member("buffer").as_unsigned());
    const ByteView buffer = buffers[index];
    const std::uint64_t offset = packed.unsigned_or("byteOffset", 0);
    const std::uint64_t length = packed.member("byteLength").as_unsigned();
    if (offset > buffer.size() || length > buffer.size() - offset) {
        packed.fail(fmt::format("{} bytes at byte {}, but buffer {} has {} bytes", length, offset,
                                index, buffer.size()));
    }
    return buffer.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

Bytes decode_view(const JsonPlace& view, const JsonPlace& packed, const std::vector<Bytes>& buffers,
                  DecodedSize& size)
{
    const MeshoptStream stream = read_stream(packed);
    const ByteView encoded = encoded_bytes(packed, buffers);
    size.add(packed, stream.count, stream.stride, encoded.size());
    const std::uint64_t length = view.member("byteLength").as_unsigned();
    if (stream.count * stream.stride < length) {
        packed.member("count").fail(
            fmt::format("{} elements of {} bytes, but the view has {} bytes", stream.count,
                        stream.stride, length));
    }
    const std::uint64_t stride = view.unsigned_or("byteStride", 0);
    if (stream.mode == MeshoptMode::attributes && stride != 0 && stride != stream.stride) {
        packed.member("byteStride")
            .fail(fmt::format("{}, but the view has {}", stream.stride, stride));
    }
    try {
        return decode_meshopt(stream, encoded);
    } catch (const Error& error) {
        packed.fail(error.what(), error.code());
    }
}

}  // namespace

std::vector<bool> find_fallback_buffers(const JsonPlace& root)
{
    const std::size_t count = root.has("buffers") ? root.member("buffers").size() : 0;
    std::vector<bool> stands_in(count, false);
    std::vector<bool> needed(count, false);
    const std::size_t views = root.has("bufferViews") ? root.member("bufferViews").size() : 0;
    for (std::size_t i = 0; i < views; ++i) {
        const JsonPlace all = root.member("bufferViews");
        const JsonPlace view = all.element(i);
        const auto buffer = static_cast<std::size_t>(view.member("buffer").as_unsigned());
        const std::optional<std::string_view> name = find_compression(view);
        if (!name) {
            needed[buffer] = true;
            continue;
        }
        const JsonPlace extensions = view.member("extensions");
        const JsonPlace packed = extensions.member(*name);
        if (has_meshopt()) {
            stands_in[buffer] = true;
            needed[static_cast<std::size_t>(packed.member("buffer").as_unsigned())] = true;
            continue;
        }
        needed[buffer] = true;
        const JsonPlace buffers = root.member("buffers");
        const JsonPlace fallback = buffers.element(buffer);
        const bool has_bytes = fallback.has("uri") || buffer == 0;
        if (!has_bytes) {
            packed.fail(
                "there is no uncompressed data, and this build of bdpt has no meshoptimizer",
                ErrorCode::unsupported);
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        stands_in[i] = stands_in[i] && !needed[i];
    }
    return stands_in;
}

void decode_meshopt_views(Json& document, std::vector<Bytes>& buffers, LoadContext& context)
{
    if (!has_meshopt() || !document.contains("bufferViews")) {
        return;
    }
    const JsonPlace root(document);
    const std::vector<bool> fallback = find_fallback_buffers(root);
    DecodedSize size(context);
    const std::size_t given = buffers.size();
    for (std::size_t i = 0; i < document["bufferViews"].size(); ++i) {
        const JsonPlace views = root.member("bufferViews");
        const JsonPlace view = views.element(i);
        const std::optional<std::string_view> name = find_compression(view);
        if (!name) {
            continue;
        }
        const JsonPlace extensions = view.member("extensions");
        buffers.push_back(decode_view(view, extensions.member(*name), buffers, size));
    }
    // Only now, as places refer into the document.
    std::size_t next = given;
    for (Json& view : document["bufferViews"]) {
        if (find_compression(JsonPlace(view))) {
            document["buffers"].push_back({{"byteLength", buffers[next].size()}});
            view["buffer"] = next++;
            view["byteOffset"] = 0u;
            for (const std::string_view extension : extension_names) {
                view["extensions"].erase(std::string(extension));
            }
        }
    }
    for (std::size_t i = 0; i < given; ++i) {
        if (fallback[i]) {
            buffers[i] = Bytes(1);
            document["buffers"][i] = {{"byteLength", 1u}};
        }
    }
}

}  // namespace bdpt::io
