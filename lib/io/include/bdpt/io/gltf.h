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

/// Times at which the shutter opens and closes [s], relative to `GltfOptions::time`; `close` is not
/// before `open`.
struct Shutter {
    double open = 0.0;
    double close = 0.0;
};

/// Progress of loading a scene.
struct LoadProgress {
    std::size_t images_done = 0;
    std::size_t images_total = 0;
};

/// Parts of a file to load, and limits.
struct GltfOptions {
    /// Name or index of the scene; none: the file's default scene, else its first.
    std::optional<std::string> scene{};
    /// Name or index of a variant of KHR_materials_variants; none: the materials of the primitives.
    std::optional<std::string> variant{};
    /// Name or index of the animation that plays, or "all"; none: the first one if there is a time.
    std::optional<std::string> animation{};
    /// Time in the animation [s]; none: its start, or the rest pose if there is no animation.
    std::optional<double> time{};
    /// Interval in which animated objects get a motion (bdpt/motion.h); none, or of no length: the
    /// image shows one moment.
    std::optional<Shutter> shutter{};
    /// Folders that the scene may name files in, beside its own. Without them URIs and symbolic
    /// links that lead out of the scene's folder are refused.
    std::vector<std::filesystem::path> allowed_folders{};
    ReadLimits limits{};
    /// Budget that the scene's memory is taken from; null: `ReadLimits::memory_bytes` are for this
    /// scene alone.
    std::shared_ptr<MemoryBudget> memory{};
    /// Called while images are decoded, after each image; on any thread, but never on two at once.
    /// An exception from it ends the loading and reaches the caller.
    std::function<void(const LoadProgress&)> on_progress{};
    /// Cache of decoded images: its images are not decoded again, others are added to it; none: no
    /// cache. Its contents do not count towards `limits`.
    std::shared_ptr<ImageCache> images{};
    /// libktx 4 of Khronos, which decodes KTX2 textures (KHR_texture_basisu): a file, or a folder
    /// with libktx.so.4; none: the library that the system finds by that name. The program
    /// bdpt-read-ktx opens it, in a separate process for each image, and only for files with such
    /// textures.
    std::optional<std::filesystem::path> ktx_library{};
    /// True: a file that requires unsupported extensions loads without them, with a warning.
    /// Compressed meshes stay required.
    bool ignore_required = false;
    /// True: a file whose picture lacks something that the file says (a missing or damaged texture,
    /// an extension that is not supported, points and lines, ...) or depends on a draft of an
    /// extension is refused (`ErrorCode::unsupported`), where it otherwise gives warnings and
    /// notes.
    bool strict = false;
};

/// Level of support of a glTF extension.
enum class ExtensionStatus : std::uint8_t {
    supported,
    draft,    ///< supported, but the specification is a draft that may change
    ignored,  ///< known, and the image is right or close without it; `note` says what is lost
    unknown,
};

/// Returns "supported", "draft", "ignored" or "unknown".
[[nodiscard]] BDPT_EXPORT std::string_view to_string(ExtensionStatus status);

/// One entry of a file's `extensionsUsed`.
struct ExtensionUse {
    std::string name;
    ExtensionStatus status = ExtensionStatus::unknown;
    bool required = false;
    std::string note;  ///< empty, or the loss in a few words
};

/// Facts about a file, for reports. Counts are for the whole file.
struct GltfFacts {
    std::string version;  ///< version of glTF
    std::string generator;
    std::string copyright;
    std::vector<std::string> scene_names;    ///< one for each scene; may be empty strings
    std::optional<std::size_t> scene;        ///< index of the loaded scene; none: the file has none
    std::vector<std::string> variant_names;  ///< from KHR_materials_variants
    std::vector<std::string> animation_names;  ///< one for each animation; may be empty strings
    std::size_t nodes = 0;
    std::size_t meshes = 0;
    std::size_t primitives = 0;
    std::size_t materials = 0;
    std::size_t textures = 0;
    std::size_t images = 0;
    std::size_t lights = 0;  ///< from KHR_lights_punctual
    std::size_t cameras = 0;
    std::size_t skins = 0;
    std::size_t animations = 0;
    std::vector<ExtensionUse> extensions;
    /// The file's packet of KHR_xmp_json_ld or KHR_xmp about itself, JSON-LD; empty: none of up to
    /// 1 MiB.
    std::string xmp;
};

/// The result of `load_gltf`.
struct LoadedScene {
    SceneDesc scene;  ///< includes the environment, if any (EXT_lights_image_based), as a light
    std::vector<CameraDesc> cameras;    ///< cameras of the scene's nodes, in the order of the nodes
    std::vector<std::string> warnings;  ///< one line each, without the file's name
    std::vector<std::string> notes;     ///< the same, about drafts of extensions
    GltfFacts facts;
    /// All files that the document names, used or not, with symbolic links followed: an output with
    /// one of these paths would overwrite the scene's data.
    std::vector<std::filesystem::path> files;
};

/// Reads a .gltf or .glb file [glTF 2.0], as its first bytes tell, with all files that it refers
/// to. "-" is the standard input, read once and kept; URIs are then relative to the working
/// directory. A scene without meshes loads with zero instances.
///
/// Throws `Error`, whose message starts with the file's path and names the place as a JSON pointer:
/// not_found (a missing or unreadable file; no such scene, variant or animation), usage (times that
/// are not finite, or a shutter that closes before it opens), invalid_input (broken, unsafe or
/// ambiguous, or over a limit), unsupported (a required extension or a glTF version that is not
/// supported; KHR_texture_basisu without libktx; what `GltfOptions::strict` refuses).
/// Non-conforming input that does no harm becomes a warning.
[[nodiscard]] BDPT_EXPORT LoadedScene load_gltf(const std::filesystem::path& file,
                                                const GltfOptions& options = {});

/// Reads the facts of a file from its JSON alone, without an index of the scene; works for files
/// that `load_gltf` refuses, too. Throws `Error`, whose message starts with the file's path:
/// not_found, or invalid_input for a file that is no glTF document or over a limit.
[[nodiscard]] BDPT_EXPORT GltfFacts read_gltf_facts(const std::filesystem::path& file,
                                                    const ReadLimits& limits = {});

/// Returns all files that a document names, used or not, as `LoadedScene::files`, from its JSON
/// alone; `allowed` are `GltfOptions::allowed_folders`. Throws `Error` as `read_gltf_facts`, and for
/// URIs that `load_gltf` refuses.
[[nodiscard]] BDPT_EXPORT std::vector<std::filesystem::path> read_gltf_files(
    const std::filesystem::path& file, const ReadLimits& limits = {},
    const std::vector<std::filesystem::path>& allowed = {});

}  // namespace bdpt::io
