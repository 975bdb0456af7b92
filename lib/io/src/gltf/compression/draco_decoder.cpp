#include "gltf/compression/compression.h"

#include "file/read_file.h"
#include "gltf/checks/checks.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

#ifdef BDPT_HAS_DRACO
#include <draco/compression/decode.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#endif

namespace bdpt::io {

#ifdef BDPT_HAS_DRACO

namespace {

[[noreturn]] void refuse(const std::string& what, ErrorCode code = ErrorCode::invalid_input)
{
    throw Error(code, "Draco: " + what);
}

/// Size of the header of a Draco file: magic, version, kind of geometry, method, flags.
constexpr std::size_t draco_head_size = 11;

draco::DecoderBuffer to_buffer(ByteView data)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
    return buffer;
}

template <typename T>
void write_values(const draco::PointAttribute& attribute, const draco::Mesh& mesh,
                  std::size_t components, Bytes& bytes)
{
    // More than any type of glTF has.
    std::array<T, 16> values{};
    for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(point));
        if (index.value() >= attribute.size() ||
            !attribute.ConvertValue<T>(index, static_cast<std::int8_t>(components),
                                       values.data())) {
            refuse(
                fmt::format("point {} has no value of attribute {}", point, attribute.unique_id()));
        }
        std::memcpy(bytes.data() + point * components * sizeof(T), values.data(),
                    components * sizeof(T));
    }
}

Bytes read_attribute(const draco::Mesh& mesh, const DracoAttribute& wanted)
{
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(wanted.id);
    if (attribute == nullptr) {
        refuse(fmt::format("there is no attribute {}", wanted.id));
    }
    Bytes bytes(mesh.num_points() * wanted.components *
                static_cast<std::size_t>(component_size(wanted.component_type)));
    switch (wanted.component_type) {
        case 5120:
            write_values<std::int8_t>(*attribute, mesh, wanted.components, bytes);
            break;
        case 5121:
            write_values<std::uint8_t>(*attribute, mesh, wanted.components, bytes);
            break;
        case 5122:
            write_values<std::int16_t>(*attribute, mesh, wanted.components, bytes);
            break;
        case 5123:
            write_values<std::uint16_t>(*attribute, mesh, wanted.components, bytes);
            break;
        case 5125:
            write_values<std::uint32_t>(*attribute, mesh, wanted.components, bytes);
            break;
        default:
            write_values<float>(*attribute, mesh, wanted.components, bytes);
    }
    return bytes;
}

std::vector<std::uint32_t> read_faces(const draco::Mesh& mesh)
{
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{mesh.num_faces()} * 3);
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(i))) {
            if (point.value() >= mesh.num_points()) {
                refuse(fmt::format("triangle {} has point {}, but the number of points is {}", i,
                                   point.value(), mesh.num_points()));
            }
            indices.push_back(point.value());
        }
    }
    return indices;
}

/// Checks the size again, as there may be more points than the header of the mesh says.
void check_size(const draco::Mesh& mesh, std::span<const DracoAttribute> attributes,
                std::uint64_t most)
{
    std::uint64_t bytes = 0;
    for (const DracoAttribute& attribute : attributes) {
        bytes += std::uint64_t{mesh.num_points()} * attribute.components *
                 component_size(attribute.component_type);
    }
    if (bytes > most) {
        refuse(fmt::format("{} points become {} bytes, but {} are left of the limit",
                           mesh.num_points(), bytes, most));
    }
}

DracoMesh decode(ByteView data, std::span<const DracoAttribute> attributes, std::uint64_t most)
{
    draco::DecoderBuffer buffer = to_buffer(data);
    draco::StatusOr<std::unique_ptr<draco::Mesh>> decoded =
        draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok() || decoded.value() == nullptr) {
        refuse("the data cannot be decoded: " + quote(decoded.status().error_msg_string()));
    }
    const draco::Mesh& mesh = *decoded.value();
    check_size(mesh, attributes, most);
    DracoMesh result;
    result.points = mesh.num_points();
    result.indices = read_faces(mesh);
    for (const DracoAttribute& attribute : attributes) {
        result.attributes.push_back(read_attribute(mesh, attribute));
    }
    return result;
}

}  // namespace

bool has_draco()
{
    return true;
}

DracoSize draco_size(ByteView data)
{
    constexpr std::array<std::uint8_t, 5> magic{'D', 'R', 'A', 'C', 'O'};
    if (data.size() < draco_head_size || !std::equal(magic.begin(), magic.end(), data.begin())) {
        refuse(fmt::format("{} bytes that do not begin like Draco data", data.size()));
    }
    const int major = data[5];
    const int minor = data[6];
    if (major != 2 || minor != 2) {
        refuse(fmt::format("bitstream {}.{}; only 2.2 is supported", major, minor),
               ErrorCode::unsupported);
    }
    if (data[7] != draco::TRIANGULAR_MESH) {
        refuse("the data is not a mesh");
    }
    const bool edgebreaker = data[8] == draco::MESH_EDGEBREAKER_ENCODING;
    const bool has_metadata = (data[10] & (METADATA_FLAG_MASK >> 8)) != 0;
    draco::DecoderBuffer buffer = to_buffer(data.subspan(draco_head_size));
    buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
    draco::GeometryMetadata metadata;
    DracoSize size;
    std::uint8_t traversal = 0;
    const bool read =
        (!has_metadata || draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) &&
        (edgebreaker ? buffer.Decode(&traversal) && draco::DecodeVarint(&size.vertices, &buffer) &&
                           draco::DecodeVarint(&size.faces, &buffer)
                     : draco::DecodeVarint(&size.faces, &buffer) &&
                           draco::DecodeVarint(&size.vertices, &buffer));
    if (!read) {
        refuse("the data is truncated");
    }
    return size;
}

DracoMesh decode_draco_mesh(ByteView data, std::span<const DracoAttribute> attributes,
                            std::uint64_t most)
{
    try {
        return decode(data, attributes, most);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        // Broken data makes the decoder request more memory than there is.
        refuse("the data cannot be decoded: " + quote(error.what()));
    }
}

#else

namespace {

constexpr const char* message = "this build of bdpt has no Draco";

}  // namespace

bool has_draco()
{
    return false;
}

DracoSize draco_size(ByteView)
{
    throw Error(ErrorCode::unsupported, message);
}

DracoMesh decode_draco_mesh(ByteView, std::span<const DracoAttribute>, std::uint64_t)
{
    throw Error(ErrorCode::unsupported, message);
}

#endif

}  // namespace bdpt::io
