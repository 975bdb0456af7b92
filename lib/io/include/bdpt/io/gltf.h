#pragma once

/// @file
/// Reads glTF files, and tells whether the files of a scene have changed.
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
///
/// @code{.cpp}
/// for (const bdpt::io::FileContent& file : bdpt::io::gltf_file_contents("room.gltf")) {
///     const std::string hash = file.hash ? bdpt::to_string(*file.hash) : "not readable";
///     std::cout << file.name << ": " << hash << '\n';
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/part/content_hash.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bdpt::io {

/// Cache of decoded images, keyed by the hash of their encoded bytes, for callers that load a file
/// repeatedly, as for the frames of an animation. Used by one load at a time.
class BDPT_EXPORT ImageCache {
public:
    /// Keeps images of up to `max_bytes` in total: the first ones, as repeated loads of a file
    /// request them in the same order.
    explicit ImageCache(std::uint64_t max_bytes) : max_bytes_(max_bytes) {}

    /// Returns the image decoded from bytes of this hash; null if it was not kept.
    [[nodiscard]] const TexelImage* find(const ContentHash& encoded) const;
    /// Keeps a copy of `image`, if there is room.
    void keep(const ContentHash& encoded, const TexelImage& image);
    /// Returns the memory of the images [bytes].
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

private:
    std::uint64_t max_bytes_;
    std::uint64_t bytes_ = 0;
    std::map<std::pair<std::uint64_t, std::uint64_t>, TexelImage> images_;
};

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
    /// The last time of each animation [s], as its accessors state it; 0: they do not.
    std::vector<double> animation_ends;
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
/// alone; `allowed` are `GltfOptions::allowed_folders`. Throws `Error` as `read_gltf_facts`, and
/// for URIs that `load_gltf` refuses.
[[nodiscard]] BDPT_EXPORT std::vector<std::filesystem::path> read_gltf_files(
    const std::filesystem::path& file, const ReadLimits& limits = {},
    const std::vector<std::filesystem::path>& allowed = {});

/// Content hash of a file that a scene is read from.
struct FileContent {
    std::string name;  ///< file name of the scene; of other files the URI in the scene
    std::optional<ContentHash> hash;  ///< hash of all its bytes; none: it cannot be read
    [[nodiscard]] bool operator==(const FileContent&) const = default;
};

/// Hashes all bytes of `file`. Throws `Error`, whose message starts with the file's path: not_found
/// if it cannot be read, invalid_input if it is over a limit.
[[nodiscard]] BDPT_EXPORT ContentHash hash_of_file(const std::filesystem::path& file,
                                                   const ReadLimits& limits = {});

/// Hashes a .gltf or .glb file and then all files that it refers to, used or not, by name: buffers,
/// images and light profiles, also in the `allowed` folders (`GltfOptions::allowed_folders`). Equal
/// contents load as equal scenes, at any time of their animations. Throws `Error`, whose message
/// starts with the file's path: not_found, or invalid_input for a file that is no glTF document or
/// over a limit.
[[nodiscard]] BDPT_EXPORT std::vector<FileContent> gltf_file_contents(
    const std::filesystem::path& file, const ReadLimits& limits = {},
    const std::vector<std::filesystem::path>& allowed = {});

}  // namespace bdpt::io
