#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/types.h>
#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "file/json.h"
#include "file/load_context.h"
#include "file/read_file.h"

namespace bdpt::io {

/// Returns the `name` of each element of the array at `pointer`, if there is one; empty if it has
/// none.
[[nodiscard]] std::vector<std::string> names_in(const Json& document, const std::string& pointer);

/// Returns the index of the element named `wanted`, or else `wanted` as an index. Throws `Error`
/// (not_found) that lists the available `what` ("scene").
[[nodiscard]] std::size_t select(std::string_view what, const std::vector<std::string>& names,
                                 const std::string& wanted);

/// Returns the extensions that a document lists, whatever they are; entries that are no strings are
/// left out.
[[nodiscard]] std::vector<ExtensionUse> list_extensions(const JsonPlace& root);

/// Returns the extensions that a document lists. Throws `Error` (unsupported) for a required one
/// that is not supported; warns of used ones that are not.
[[nodiscard]] std::vector<ExtensionUse> check_extensions(const JsonPlace& root,
                                                         LoadContext& context);

/// A glTF document that has passed all checks which need no vertex data.
struct CheckedGltf {
    Json document;
    std::vector<Bytes> buffers;  ///< each at least as long as its `byteLength`
    std::vector<ExtensionUse> extensions;
    std::vector<std::filesystem::path> files;  ///< named by its URIs, used or not
};

/// Reads and checks a document and its buffers before any other code sees it. Throws `Error`; the
/// message lacks the file's path.
[[nodiscard]] CheckedGltf read_checked_gltf(const std::filesystem::path& file,
                                            LoadContext& context);

/// Returns the files that the URIs of a document name, used or not. Throws `Error` for those that
/// lead out of its folders.
[[nodiscard]] std::vector<std::filesystem::path> checked_uris(const JsonPlace& root,
                                                              LoadContext& context);

/// Collects the facts about a document, without the index of the loaded scene. The document has an
/// "asset".
[[nodiscard]] GltfFacts collect_facts(const CheckedGltf& checked);

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

/// Interpretation of integers in an accessor.
enum class Integers : std::uint8_t {
    as_declared,  ///< by the accessor's `normalized`
    normalized,   ///< fractions of the greatest value [glTF 2.0, sec. 3.6.2.2]
    whole,        ///< unscaled
};

/// Reads the elements of an accessor, with sparse ones applied [glTF 2.0, sec. 3.6.2.3]. V is Vec2,
/// Vec3 or Vec4 and must be the accessor's type. Relies on check_layout. Throws `Error`
/// (invalid_input).
template <typename V>
[[nodiscard]] std::vector<V> read_vectors(const tinygltf::Model& model, int accessor,
                                          Integers integers = Integers::as_declared);

/// Reads the components of all elements of an accessor, whose type must be `type` (of tinygltf) and
/// have no padding. Relies on check_layout. Throws `Error` (invalid_input).
[[nodiscard]] std::vector<float> read_numbers(const tinygltf::Model& model, int accessor, int type,
                                              Integers integers = Integers::as_declared);

/// Reads the elements of an accessor of unsigned scalars. Throws `Error` (invalid_input).
[[nodiscard]] std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor);

}  // namespace bdpt::io
