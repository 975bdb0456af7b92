#pragma once

/// @file
/// Limits the memory and the time that files may take.
///
/// @code{.cpp}
/// bdpt::io::GltfOptions options;
/// options.limits.file_bytes = 100'000'000;
/// options.limits.triangles = 1'000'000;
/// const bdpt::Scene scene(bdpt::io::load_gltf("upload.glb", options).scene);
/// @endcode

#include <cstddef>
#include <cstdint>

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

}  // namespace bdpt::io
