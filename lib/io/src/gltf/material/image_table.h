#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/scene_desc.h>
#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "file/load_context.h"
#include "file/read_file.h"
#include "gltf/document/document.h"
#include "image/encoded_image.h"

namespace bdpt::io {

/// Decodes the images of a document, several at once and each only once.
class ImageTable {
public:
    /// The arguments must outlive the table. Images are added to `images`.
    ImageTable(const tinygltf::Model& model, std::vector<TexelImage>& images, LoadContext& context)
        : model_(model), images_(images), context_(context)
    {}

    /// Decodes these images of the document and adds them in that order; those that cannot be read
    /// or decoded are left out, with a warning. `on_progress` may be empty. Throws `Error`
    /// (invalid_input) about the first image that is beyond the limits, independently of thread
    /// timing.
    void decode(const std::vector<std::size_t>& indices,
                const std::function<void(const LoadProgress&)>& on_progress);

    /// Returns image `index` of the document, decoding it if necessary; none if it cannot be read
    /// or decoded.
    [[nodiscard]] std::optional<ImageId> get(std::size_t index);

    /// Warns if an image states another colour encoding than `wanted`, the one of the texture,
    /// which is used.
    void check_encoding(ImageId id, ColorEncoding wanted);

private:
    struct Job;
    [[nodiscard]] bool take_kept(Job& job) const;
    void spend(std::uint64_t bytes);
    void open(Job& job);
    void finish(std::deque<Job>& batch, const std::function<void()>& tell);
    void add(Job& job);

    const tinygltf::Model& model_;
    std::vector<TexelImage>& images_;
    LoadContext& context_;
    struct SaidEncoding {
        std::size_t index;  // index of the image in the document
        ColorEncoding encoding;
    };
    std::map<std::size_t, std::optional<ImageId>> known_;
    std::map<ImageId, SaidEncoding> encodings_;  // encodings stated by images
    std::uint64_t total_bytes_ = 0;
    std::uint64_t packed_bytes_ = 0;      // size of the current batch
    std::uint64_t max_packed_bytes_ = 0;  // maximum over batches so far
};

/// Reads the materials of these indices; a negative one is the default material [glTF 2.0, sec.
/// 3.7.2.1]. All images that they need are decoded together.
[[nodiscard]] std::vector<MaterialDesc> read_materials(
    const tinygltf::Model& model, const std::vector<int>& indices, ImageTable& images,
    const std::function<void(const LoadProgress&)>& on_progress, LoadContext& context);

}  // namespace bdpt::io
