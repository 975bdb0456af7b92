#pragma once

/// @file
/// Limits the memory and the time that files may take, and the memory that a scene and its render
/// take together.
///
/// @code{.cpp}
/// bdpt::io::GltfOptions options;
/// options.limits.file_bytes = 100'000'000;
/// options.limits.triangles = 1'000'000;
/// const bdpt::Scene scene(bdpt::io::load_gltf("upload.glb", options).scene);
/// @endcode
///
/// @code{.cpp}
/// const auto memory = std::make_shared<bdpt::io::MemoryBudget>(
///     bdpt::io::MemoryLimit{.bytes = std::uint64_t{4} << 30, .source = "the job's limit"});
/// bdpt::io::GltfOptions options;
/// options.memory = memory;
/// const bdpt::Scene scene(bdpt::io::load_gltf("city.glb", options).scene);
/// std::cout << memory->left() << " bytes are left for the film\n";
/// @endcode

#include <bdpt/error.h>
#include <bdpt/export.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace bdpt::io {

/// Limits on the resources that a file may take. A file beyond a limit is refused
/// (`ErrorCode::invalid_input`) before the memory or the time is spent. The defaults let every
/// sensible scene pass.
struct ReadLimits {
    std::uint64_t file_bytes = std::uint64_t{4} << 30;    ///< per file
    std::uint64_t buffer_bytes = std::uint64_t{8} << 30;  ///< all glTF buffers together
    std::uint64_t json_bytes = std::uint64_t{1} << 30;    ///< JSON text, data URIs included
    std::size_t json_depth = 64;                          ///< nested objects and arrays
    std::size_t json_values = 50'000'000;  ///< objects, arrays, strings, numbers, ...
    std::size_t nodes = 1'000'000;
    std::size_t node_depth = 512;
    std::size_t instances = 10'000'000;
    /// Decoded vertices, key frames, light profiles and instances; an accessor counts as often as
    /// it is used.
    std::uint64_t mesh_bytes = std::uint64_t{16} << 30;
    std::uint64_t triangles = 500'000'000;                 ///< all meshes, each mesh once
    int image_side = 16384;                                ///< [pixels]
    std::uint64_t image_bytes = std::uint64_t{2} << 30;    ///< per image, decoded
    std::uint64_t texture_bytes = std::uint64_t{8} << 30;  ///< all images together, decoded
    std::uint64_t volume_bytes = std::uint64_t{4} << 30;   ///< densities of one volume
    /// CPU time for reading a volume of the greatest size; smaller files get less, as broken ones
    /// may loop.
    std::uint64_t volume_seconds = 300;
    /// Decoded over encoded size of compressed meshes; meshes below 64 MiB are not checked.
    std::uint64_t compression_ratio = 1000;
    /// Estimated memory of buffers, vertices, images and acceleration structures together, while a
    /// scene is loaded.
    std::uint64_t memory_bytes = std::uint64_t{64} << 30;
};

/// A memory limit and its source.
struct MemoryLimit {
    std::uint64_t bytes = 0;
    std::string source;  ///< for people, such as "--max-memory"
    /// Code of the error when memory is refused: invalid_input if somebody chose the limit,
    /// out_of_memory if the machine has no more.
    ErrorCode code = ErrorCode::invalid_input;
};

/// Shared memory budget of one scene or one render: documents, buffers, images, meshes, instances,
/// volumes, environments and films. Each is charged before it is allocated; the numbers estimate
/// its whole cost, with all that is built from it. For one thread.
class BDPT_EXPORT MemoryBudget {
public:
    explicit MemoryBudget(MemoryLimit limit) : limit_(std::move(limit)) {}

    /// Charges `bytes` for `what`, which begins the message if the budget is exceeded ("the film of
    /// 16x16 pixels"). Throws `Error` (with the code of the limit) that names what, how much, and
    /// the limit with its source.
    void spend(std::string_view what, std::uint64_t bytes);
    /// Throws as `spend` does, but charges nothing: for short-lived memory.
    void check(std::string_view what, std::uint64_t bytes) const;

    [[nodiscard]] const MemoryLimit& limit() const { return limit_; }
    [[nodiscard]] std::uint64_t spent() const { return spent_; }
    [[nodiscard]] std::uint64_t left() const { return limit_.bytes - spent_; }

private:
    MemoryLimit limit_;
    std::uint64_t spent_ = 0;  // [bytes], at most the limit
};

}  // namespace bdpt::io
