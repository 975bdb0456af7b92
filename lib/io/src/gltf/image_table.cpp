#include "gltf/image_table.h"

#include "file/read_file.h"
#include "file/uri.h"
#include "image/texels.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace bdpt::io {

namespace {

/// A failure that costs one picture only, unlike `Error`.
struct UnreadablePicture : std::runtime_error {
    using std::runtime_error::runtime_error;
};

Bytes read_picture_file(const std::filesystem::path& folder, const std::string& uri,
                        const ReadLimits& limits)
{
    const std::filesystem::path file = resolve_uri(folder, uri);
    try {
        return read_file(file, limits.file_bytes);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::not_found) {
            throw UnreadablePicture(quote(uri) + ": " + error.what());
        }
        throw;
    }
}

}  // namespace

TexelImage ImageTable::decode(const ImageSource& source) const
{
    if (source.buffer_view) {
        const tinygltf::BufferView& view = model_.structs.bufferViews[*source.buffer_view];
        const auto& data = model_.structs.buffers[static_cast<std::size_t>(view.buffer)].data;
        return decode_texels(ByteView(data).subspan(view.byteOffset, view.byteLength), limits_);
    }
    if (source.uri.empty()) {
        throw UnreadablePicture("neither \"uri\" nor \"bufferView\"");
    }
    if (is_data_uri(source.uri)) {
        return decode_texels(decode_data_uri(source.uri, limits_.file_bytes), limits_);
    }
    return decode_texels(read_picture_file(model_.folder, source.uri, limits_), limits_);
}

std::optional<ImageId> ImageTable::get(std::size_t index)
{
    const auto [found, is_new] = known_.try_emplace(index);
    if (!is_new) {
        return found->second;
    }
    const std::string place = fmt::format("/images/{}", index);
    try {
        TexelImage image = decode(model_.images[index]);
        total_bytes_ += image.rgba.size();
        if (total_bytes_ > limits_.texture_bytes) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("all pictures together need more than {}",
                                    human_bytes(static_cast<long double>(limits_.texture_bytes))));
        }
        found->second = static_cast<ImageId>(images_.size());
        images_.push_back(std::move(image));
    } catch (const Error& error) {
        throw Error(error.code(), place + ": " + error.what());
    } catch (const std::runtime_error& error) {
        warnings_.add("the picture cannot be read; the material does without it",
                      place + ": " + error.what());
    }
    return found->second;
}

}  // namespace bdpt::io
