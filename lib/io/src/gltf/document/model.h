#pragma once

#include "file/bytes.h"
#include "file/load_context.h"
#include "gltf/document/prepass.h"

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace bdpt::io {

/// Returns light `index` of an extension of the document, which must have it.
[[nodiscard]] const tinygltf::Value& find_light(const tinygltf::Model& model, const char* extension,
                                                std::size_t index);

/// Reads the bytes of a file or a data URI or, if `uri` is empty, of a view (-1: none). Throws
/// `Error`: not_found for a missing file, invalid_input if it is larger than `limit` bytes, or
/// neither is given.
[[nodiscard]] Bytes read_source(const tinygltf::Model& model, const std::string& uri,
                                int buffer_view, std::uint64_t limit, const LoadContext& context);

/// Converts a checked document to the structs of tinygltf, with all that the loader reads. Images
/// have their `uri` as in the file, or their `bufferView`; nothing is decoded. Animations other
/// than the `played` ones are empty; check_animations must have checked the played ones.
[[nodiscard]] tinygltf::Model build_model(CheckedGltf checked, std::span<const std::size_t> played);

}  // namespace bdpt::io
