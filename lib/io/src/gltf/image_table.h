#pragma once

#include "file/warnings.h"
#include "gltf/model.h"

#include <bdpt/io/read_limits.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace bdpt::io {

/// Decodes the pictures of a document, each when it is first asked for and only once.
class ImageTable {
public:
    /// The arguments must outlive the table. Pictures are added to `images`.
    ImageTable(const GltfModel& model, const ReadLimits& limits, std::vector<TexelImage>& images,
               Warnings& warnings)
        : model_(model), limits_(limits), images_(images), warnings_(warnings)
    {}

    /// Picture `index` of the document; none, with a warning, if it cannot be read or decoded.
    /// Throws `Error` (invalid_input) when it is beyond the limits.
    [[nodiscard]] std::optional<ImageId> get(std::size_t index);

private:
    [[nodiscard]] TexelImage decode(const ImageSource& source) const;

    const GltfModel& model_;
    const ReadLimits& limits_;
    std::vector<TexelImage>& images_;
    Warnings& warnings_;
    std::map<std::size_t, std::optional<ImageId>> known_;
    std::uint64_t total_bytes_ = 0;
};

}  // namespace bdpt::io
