#pragma once

/// @file
/// Reads glTF files.
///
/// @code{.cpp}
/// bdpt::io::GltfOptions options;
/// options.time = 1.5;                                               // [s] of its animation
/// options.shutter = bdpt::io::Shutter{.open = 0.0, .close = 0.02};  // blurs what moves
/// bdpt::io::LoadedScene file = bdpt::io::load_gltf("walk.glb", options);
/// for (const std::string& warning : file.warnings) {
///     std::cerr << "walk.glb: " << warning << '\n';
/// }
/// const bdpt::Scene scene(std::move(file.scene));
/// @endcode

#include <bdpt/export.h>
#include <bdpt/io/image_cache.h>
#include <bdpt/io/memory_budget.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// When the shutter is open [s], counted from `GltfOptions::time`. Not before it opens does it
/// close.
struct Shutter {
    double open = 0.0;
    double close = 0.0;
};

/// How far a scene is loaded.
struct LoadProgress {
    std::size_t images_done = 0;
    std::size_t images_total = 0;
};

/// The parts of a file to load, and the limits.
struct GltfOptions {
    /// Name or index of the scene; none: the file's default scene, else its first.
    std::optional<std::string> scene{};
    /// Name or index of a variant of KHR_materials_variants; none: the materials of the primitives.
    std::optional<std::string> variant{};
    /// Name or index of the animation that plays, or "all"; none: the first one if there is a time.
    std::optional<std::string> animation{};
    /// Moment of the animation to show [s]; none: its start, or with no animation the nodes rest.
    std::optional<double> time{};
    /// What the animation moves in this time gets a motion (bdpt/motion.h); none, or of no length:
    /// the image is of one moment.
    std::optional<Shutter> shutter{};
    ReadLimits limits{};
    /// What the scene takes is taken from it; null: `ReadLimits::memory_bytes` are for it alone.
    std::shared_ptr<MemoryBudget> memory{};
    /// Called while images are decoded, each time that one is done; on any thread, but never on
    /// two at once. What it throws ends the loading and reaches the caller.
    std::function<void(const LoadProgress&)> on_progress{};
    /// Images that are in it are not decoded again, others are added; none: nothing is kept. What
    /// it holds is not counted by `limits`.
    std::shared_ptr<ImageCache> images{};
    /// libktx 4 of Khronos, which decodes KTX2 textures (KHR_texture_basisu): a file, or a folder
    /// with libktx.so.4; none: what the system finds by that name. It is opened by the program
    /// bdpt-read-ktx, in a process of its own for each image, and for files with such textures
    /// only.
    std::optional<std::filesystem::path> ktx_library{};
    /// A file that requires extensions which are not supported loads without what they add, with a
    /// warning. Compressed meshes stay required.
    bool ignore_required = false;
};

/// The support of a glTF extension.
enum class ExtensionStatus : std::uint8_t {
    supported,
    ignored,  ///< known, and the image is right or close without it; `note` says what is lost
    unknown,
};

/// "supported", "ignored" or "unknown".
[[nodiscard]] BDPT_EXPORT std::string_view to_string(ExtensionStatus status);

/// One entry of a file's `extensionsUsed`.
struct ExtensionUse {
    std::string name;
    ExtensionStatus status = ExtensionStatus::unknown;
    bool required = false;
    std::string note;  ///< empty, or what is lost, in a few words
};

/// The contents of a file, for reports. Counts are those of the whole file.
struct GltfFacts {
    std::string version;  ///< of glTF
    std::string generator;
    std::string copyright;
    std::vector<std::string> scene_names;    ///< one for each scene; may be empty strings
    std::optional<std::size_t> scene;        ///< index of the loaded scene; none: the file has none
    std::vector<std::string> variant_names;  ///< of KHR_materials_variants
    std::vector<std::string> animation_names;  ///< one for each animation; may be empty strings
    std::size_t nodes = 0;
    std::size_t meshes = 0;
    std::size_t primitives = 0;
    std::size_t materials = 0;
    std::size_t textures = 0;
    std::size_t images = 0;
    std::size_t lights = 0;  ///< of KHR_lights_punctual
    std::size_t cameras = 0;
    std::size_t skins = 0;
    std::size_t animations = 0;
    std::vector<ExtensionUse> extensions;
    /// The packet of KHR_xmp_json_ld or KHR_xmp that the file has about itself, JSON-LD; empty:
    /// none of up to 1 MiB.
    std::string xmp;
};

/// The result of `load_gltf`.
struct LoadedScene {
    SceneDesc scene;  ///< its environment, if it has one (EXT_lights_image_based), is a light
    std::vector<CameraDesc> cameras;    ///< those of the scene's nodes, in the order of the nodes
    std::vector<std::string> warnings;  ///< one line each, without the file's name
    GltfFacts facts;
    /// All files that the document names, used or not, with symbolic links followed: an output that
    /// is one of them would overwrite what the scene is made of.
    std::vector<std::filesystem::path> files;
};

/// Reads a .gltf or .glb file [glTF 2.0] with all that it refers to; which of the two it is, its
/// first bytes say. "-" is the standard input, read once and kept; URIs start from the working
/// directory then. A scene without meshes loads with zero instances.
///
/// Throws `Error`, whose message starts with the file's path and names the place as a JSON pointer:
/// not_found (a file that is missing or unreadable; no such scene, variant or animation),
/// usage (times that are not finite, or a shutter that closes before it opens),
/// invalid_input (broken, unsafe or ambiguous, or over a limit), unsupported (a required extension,
/// or a glTF version, that we do not have;
/// KHR_texture_basisu where there is no libktx). What is merely not conforming becomes a warning.
[[nodiscard]] BDPT_EXPORT LoadedScene load_gltf(const std::filesystem::path& file,
                                                const GltfOptions& options = {});

/// What a file says and holds by its JSON alone, without an index of the scene; also of a file that
/// `load_gltf` refuses. Throws `Error`, whose message starts with the file's path: not_found, or
/// invalid_input for what is no glTF document or over a limit.
[[nodiscard]] BDPT_EXPORT GltfFacts read_gltf_facts(const std::filesystem::path& file,
                                                    const ReadLimits& limits = {});

}  // namespace bdpt::io
